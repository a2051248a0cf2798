"""Controller libraries, one folder each, named as B&R names it."""
