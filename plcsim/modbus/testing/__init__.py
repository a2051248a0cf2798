"""The operator of an HMI, as tests have one."""
