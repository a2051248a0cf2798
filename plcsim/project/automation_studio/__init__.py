"""Automation Studio projects, as they lie on the disk: read, never written."""
