"""The node on a controller: the table [ros], the bridge, the embedded master."""
