"""The service process of the pages."""
