"""The controller in a browser: a service process beside the scan, and the pages it serves."""
