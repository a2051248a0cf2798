/* An action client: sends the arm where target says when send is set, and looks where its hand is. */

#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif

void _INIT ProgramInit(void)
{
	node = cRosNodeCreate("/panel");
	client = cRosActionClient(node, "/arm/follow", "control_msgs/FollowJointTrajectory");
	frames = cRosTfListener(node);
}

static void send_goal(void)
{
	UDINT message = cRosActionNewGoal(client);

	goal_struct.trajectory.points_length = 1;
	goal_struct.trajectory.points[0].positions_length = 2;
	goal_struct.trajectory.points[0].positions[0] = target;
	goal_struct.trajectory.points[0].positions[1] = target;
	cRosMessageFromStruct(message, (UDINT)&goal_struct, sizeof(goal_struct));
	cRosActionRelease(goal);
	goal = cRosActionSendGoal(client, message);
	feedbacks = 0;
	error_code = 0;
}

void _CYCLIC ProgramCyclic(void)
{
	UDINT message;

	cRosNodeDoEventsLoop(node);
	connected = cRosActionConnected(client);
	if (send && connected) {
		send = 0;
		send_goal();
	}
	if (cancel) {
		cancel = 0;
		cRosActionCancel(goal);
	}
	state = cRosActionState(goal);
	if (cRosActionNextFeedback(goal) != 0)
		feedbacks++;
	message = cRosActionResult(goal);
	if (message != 0) {
		error_code = (DINT)cRosMessageGetFieldInt(cRosMessageGetField(message, "error_code"), 0);
		cRosActionText(goal, (UDINT)&text, sizeof(text));
	}
	lookup = cRosTfLookup(frames, "world", "hand", 0, &hand);
}

void _EXIT ProgramExit(void)
{
	cRosNodeDestroy(node);
}
