from crosnode.budget import UNPACED, Budget, StepLimits


def test_a_budget_starts_with_all_limits() -> None:
    budget = Budget(StepLimits())
    assert {name: getattr(budget, name) for name in StepLimits._fields} == StepLimits()._asdict()


def test_unpaced_is_more_of_everything() -> None:
    assert all(most > some for most, some in zip(UNPACED, StepLimits(), strict=True))
