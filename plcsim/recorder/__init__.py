"""Record and replay: what a controller did, in bags, and the same again, cycle by cycle."""
