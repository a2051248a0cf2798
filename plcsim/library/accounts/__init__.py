"""ArUser: the users that a program makes, with their passwords, roles and properties."""
