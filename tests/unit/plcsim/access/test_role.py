from plcsim.access import Role


def test_each_role_includes_those_before_it():
    included = [[each for each in Role if role.includes(each)] for role in Role]
    assert included == [[Role.LOOK], [Role.LOOK, Role.OPERATE], list(Role)]
