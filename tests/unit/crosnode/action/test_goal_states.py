"""The table of a goal: every state is reached, and every one leads to an end."""

from crosnode.action.goal_states import GOAL, TERMINAL, GoalState


def test_every_state_is_reached_and_leads_to_an_end() -> None:
    reached = {GoalState.PENDING} | {to for row in GOAL.values() for to in row.values()}
    assert reached == set(GoalState) == set(GOAL)
    for state in GOAL:
        seen, todo = set(), [state]
        while todo:
            here = todo.pop()
            if here not in seen:
                seen.add(here)
                todo += GOAL[here].values()
        assert seen & TERMINAL


def test_the_numbers_are_those_of_the_message() -> None:
    from crosnode.messages import MessageTypes

    constants = MessageTypes().message("actionlib_msgs/GoalStatus").constants
    assert {state.name: state.value for state in GoalState}.items() <= constants.items()
