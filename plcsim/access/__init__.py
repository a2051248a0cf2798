"""Who may do what: users with roles, tokens for scripts, and lines on what they did.

The pages ([web]) and OPC UA ([opcua]) share one file of users of the project, ``plcsim users``
keeps it. Modbus has none: its peers are known by their certificates.
"""

from plcsim.access.line_file import LineFile
from plcsim.access.role import Role
from plcsim.access.users import User, Users, UsersError

__all__ = ["LineFile", "Role", "User", "Users", "UsersError"]
