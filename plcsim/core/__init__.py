"""The controller itself: memory, clock, tags, tasks, the scan. Imports nothing else of plcsim."""
