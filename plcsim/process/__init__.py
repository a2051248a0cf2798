"""The processes of a run: parent, scan, services; what they leave behind."""
