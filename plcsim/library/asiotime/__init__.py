"""Library AsIOTime: times of the I/O cycle."""
