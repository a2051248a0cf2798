"""What a node offers those who look after it: diagnostics, and values that they may change."""
