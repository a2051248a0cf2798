"""Actions by handles: what a program in Structured Text or C can do wrong, and what it gets."""

from crosnode.action.client import MOST_GOALS, ActionClient
from crosnode.action.goal_states import GoalState
from crosnode.action.server import ActionServer
from crosnode.interface import actions, fields, messages, nodes
from crosnode.interface.interface import (
    CrosGoalState,
    crosERR_HANDLE,
    crosERR_STATE,
    crosERR_VALUE,
)

from .site import Site

TEST = "actionlib/Test"
LOST = CrosGoalState.CROS_GOAL_LOST


def served(site: Site) -> tuple[int, ActionClient]:
    """Return the handle of a server, and a client that is connected."""
    server = actions.server(site.context, site.node, site.text("/count"), site.text(TEST))
    assert server
    client = ActionClient(site.other, "/count", TEST)
    site.world.steps.append(client.step)
    site.world.until(lambda: client.is_connected)
    return server, client


def new_goal(site: Site, server: int, client: ActionClient, number: int = 5) -> int:
    client.send(goal=number)
    found: list[int] = []

    def came() -> int:
        found.append(actions.next_goal(site.context, server))
        return found[-1]

    site.world.until(came)
    return found[-1]


def test_a_goal_from_its_message_to_its_result(site: Site) -> None:
    server, client = served(site)
    wanted = client.send(goal=21)
    site.world.run(20)
    goal = actions.next_goal(site.context, server)
    message = actions.goal_message(site.context, goal)
    assert message == actions.goal_message(site.context, goal)
    assert fields.get_int(site.context, site.field(message, "goal"), 0) == 21
    assert actions.accept(site.context, goal) == 0
    assert actions.state(site.context, goal) == GoalState.ACTIVE
    feedback = actions.new_feedback(site.context, goal)
    fields.set_int(site.context, site.field(feedback, "feedback"), 0, 3)
    assert actions.send_feedback(site.context, goal, feedback) == 0
    result = actions.new_result(site.context, goal)
    fields.set_int(site.context, site.field(result, "result"), 0, 42)
    end = actions.end(site.context, goal, GoalState.SUCCEEDED, result, site.text("twice"))
    assert end == 0
    site.world.until(lambda: wanted.is_over)
    assert wanted.result is not None
    assert wanted.feedback is not None
    assert (wanted.result.result, wanted.feedback.feedback) == (42, 3)
    assert (wanted.state, wanted.text) == (GoalState.SUCCEEDED, "twice")
    # all of it is released
    assert actions.state(site.context, goal) == LOST
    assert messages.free(site.context, message) == crosERR_HANDLE
    assert messages.free(site.context, feedback) == crosERR_HANDLE


def test_what_a_state_does_not_allow_is_a_status(site: Site) -> None:
    server, client = served(site)
    goal = new_goal(site, server, client)
    text, result = site.text(""), actions.new_result(site.context, goal)
    assert actions.end(site.context, goal, GoalState.SUCCEEDED, result, text) == crosERR_STATE
    assert actions.end(site.context, goal, GoalState.ACTIVE, result, text) == crosERR_VALUE
    assert actions.accept(site.context, goal) == 0
    assert actions.accept(site.context, goal) == crosERR_STATE
    feedback = actions.new_feedback(site.context, goal)
    assert actions.end(site.context, goal, GoalState.ABORTED, feedback, text) == crosERR_HANDLE
    assert actions.send_feedback(site.context, goal, result) == crosERR_HANDLE
    assert actions.end(site.context, goal, GoalState.ABORTED, 0, text) == 0
    assert actions.end(site.context, goal, GoalState.ABORTED, 0, text) == crosERR_HANDLE


def test_a_goal_that_is_canceled_before_it_is_accepted(site: Site) -> None:
    server, client = served(site)
    sent = client.send(goal=1)
    site.world.run(20)
    goal = actions.next_goal(site.context, server)
    client.cancel(sent)
    site.world.until(lambda: actions.state(site.context, goal) == GoalState.RECALLING)
    assert actions.end(site.context, goal, GoalState.PREEMPTED, 0, site.text("")) == 0
    site.world.until(lambda: sent.is_over)
    assert sent.state is GoalState.RECALLED


def test_a_client_sends_stops_and_reads(site: Site) -> None:
    client = actions.client(site.context, site.node, site.text("/count"), site.text(TEST))
    server = ActionServer(site.other, "/count", TEST)
    site.world.steps.append(server.step)
    assert not actions.is_connected(site.context, client)
    site.world.until(lambda: actions.is_connected(site.context, client))
    message = actions.new_goal(site.context, client)
    fields.set_int(site.context, site.field(message, "goal"), 0, 7)
    goal = actions.send_goal(site.context, client, message)
    assert goal
    assert messages.free(site.context, message) == crosERR_HANDLE
    site.world.until(lambda: server.goals)
    (taken,) = server.goals
    assert taken.goal.goal == 7
    taken.accept()
    taken.feedback(feedback=1)
    taken.feedback(feedback=2)
    site.world.until(lambda: actions.state(site.context, goal) == GoalState.ACTIVE)
    first = actions.next_feedback(site.context, goal)
    assert fields.get_int(site.context, site.field(first, "feedback"), 0) in (1, 2)
    assert actions.next_feedback(site.context, goal) == 0
    assert actions.result(site.context, goal) == 0
    assert actions.cancel(site.context, goal) == 0
    site.world.until(lambda: taken.is_canceled)
    taken.set_canceled("stopped", result=-1)
    site.world.until(lambda: actions.result(site.context, goal))
    result = actions.result(site.context, goal)
    assert fields.get_int(site.context, site.field(result, "result"), 0) == -1
    assert actions.state(site.context, goal) == GoalState.PREEMPTED
    area = site.area(20)
    assert actions.text(site.context, goal, area, 20) == 0
    assert site.string(area) == "stopped"
    assert actions.release(site.context, goal) == 0
    assert actions.release(site.context, goal) == crosERR_HANDLE
    assert messages.free(site.context, result) == crosERR_HANDLE


def test_goals_that_nobody_releases_are_bounded(site: Site) -> None:
    client = actions.client(site.context, site.node, site.text("/count"), site.text(TEST))
    goals = [
        actions.send_goal(site.context, client, actions.new_goal(site.context, client))
        for _ in range(MOST_GOALS + 5)
    ]
    assert all(goals)
    states = [actions.state(site.context, goal) for goal in goals]
    assert states == [LOST] * 5 + [GoalState.PENDING] * MOST_GOALS


def test_what_is_no_handle_is_refused(site: Site) -> None:
    text = site.text("")
    assert actions.server(site.context, 0, text, text) == 0
    assert actions.server(site.context, site.node, site.text("/x"), site.text("no/Type")) == 0
    assert actions.next_goal(site.context, 1) == 0
    assert actions.goal_message(site.context, 1) == 0
    assert actions.new_goal(site.context, 1) == 0
    assert actions.new_result(site.context, 1) == 0
    assert actions.send_goal(site.context, 1, 1) == 0
    assert actions.next_feedback(site.context, 1) == 0
    assert actions.result(site.context, 1) == 0
    assert actions.state(site.context, 1) == LOST
    for answer in (
        actions.accept(site.context, 1),
        actions.send_feedback(site.context, 1, 1),
        actions.end(site.context, 1, 3, 0, text),
        actions.cancel(site.context, 1),
        actions.text(site.context, 1, 0, 0),
    ):
        assert answer == crosERR_HANDLE


def test_a_node_that_ends_takes_its_goals_along(site: Site) -> None:
    server, client = served(site)
    goal = new_goal(site, server, client)
    message = actions.goal_message(site.context, goal)
    nodes.destroy(site.context, site.node)
    assert actions.state(site.context, goal) == LOST
    assert messages.free(site.context, message) == crosERR_HANDLE
    assert actions.next_goal(site.context, server) == 0
