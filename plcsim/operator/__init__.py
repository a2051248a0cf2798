"""Who and what stands around the machine: an operator's steps, inputs, signals that come back."""
