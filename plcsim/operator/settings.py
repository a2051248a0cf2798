"""The table [operator] of plc.toml; docs/automation-studio.md lists its keys."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, Any

from plcsim.settings import Duration, Key, settings


@settings
class StepSettings:
    """One step: what somebody does.

    Attributes:
        after_ns: time since the end of the step before, for the first since the start.
        when: values of tags to be waited for after that, all at once.
        values: what tags are set to.
        hold_ns: after this time the tags get their values of before back, and the step ends; None
            for a step that ends at once and leaves them.
    """

    after_ns: Annotated[int, Duration()] = 0
    when: Mapping[str, Any] = field(default_factory=dict)
    values: Annotated[Mapping[str, Any], Key("set")]
    hold_ns: Annotated[int | None, Key("for"), Duration(minimum_ns=1)] = None


@settings
class FollowSettings:
    """A tag that follows another one.

    Attributes:
        of: the other one, of the same type.
        after_ns: how long the other one has its value before this one gets it.
        inverse: of a BOOL: this one gets the opposite.
    """

    of: str
    after_ns: Annotated[int, Duration()] = 0
    inverse: bool = False


@settings
class OperatorSettings:
    """What [operator] says.

    Attributes:
        inputs: values that tags get at the start and in every LATCH.
        follow: tags that follow others, as a limit switch follows a valve.
        steps: what somebody does, one after another.
        repeat: after the last step comes the first again.
    """

    inputs: Mapping[str, Any] = field(default_factory=dict)
    follow: Mapping[str, FollowSettings] = field(default_factory=dict)
    steps: Annotated[tuple[StepSettings, ...], Key("step")] = ()
    repeat: bool = False
