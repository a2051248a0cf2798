"""From typed trees to the intermediate representation: here the semantics are decided."""
