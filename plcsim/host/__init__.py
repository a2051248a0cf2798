"""What the scan takes from the machine: real-time rights, garbage, descriptors."""
