(* The node for Structured Text and C: the functions of the thesis (section 1.3), with handles where C
   has pointers. A node, a publisher, a message, a field is a UDINT that only the node understands; 0
   is none. A handle of a message is good until it is sent, answered or released, that of a received
   one until the next is asked for; those of its fields as long; all others until their node ends.
   Nothing here waits: what takes time is a function block with a status, or is asked for again in the
   next cycle.

   A status is 0, ERR_FUB_BUSY while it goes on, or one of crosERR_... *)

(* The node *)

FUNCTION cRosNodeCreate : UDINT (*makes a node in INIT; returns its handle, 0 where no port can be opened*)
	VAR_INPUT
		node_name : STRING[CROS_NAME_LENGTH]; (*such as /talker_cros*)
	END_VAR
END_FUNCTION

FUNCTION cRosNodeDoEventsLoop : UINT (*one bounded step: call it once a cycle*)
	VAR_INPUT
		node : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosNodeDestroy : UINT (*takes all back and closes, in EXIT*)
	VAR_INPUT
		node : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosNodeIsRegistered : BOOL (*the master knows all that was registered*)
	VAR_INPUT
		node : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosNodePopStatus : BOOL (*takes the oldest news; FALSE where there is none*)
	VAR_INPUT
		node : UDINT;
	END_VAR
	VAR_IN_OUT
		news : CrosNodeNews;
	END_VAR
END_FUNCTION

FUNCTION cRosNodeTime : BOOL (*ROS time of this cycle; FALSE while it is not known*)
	VAR_INPUT
		node : UDINT;
	END_VAR
	VAR_IN_OUT
		time : CrosTime;
	END_VAR
END_FUNCTION

FUNCTION cRosLog : UINT (*publishes a line on /rosout*)
	VAR_INPUT
		node : UDINT;
		level : CrosLogLevel;
		msg : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

(* What a program registers, in INIT *)

FUNCTION cRosApiRegisterPublisher : UDINT (*returns the handle of the publisher, 0 for an unknown type or name*)
	VAR_INPUT
		node : UDINT;
		topic_name : STRING[CROS_NAME_LENGTH];
		topic_type : STRING[CROS_NAME_LENGTH]; (*such as std_msgs/String*)
		loop_period : DINT; (*ms after which cRosNextMsg gives a message to fill, -1 for never*)
		latching : BOOL; (*a new subscriber gets the last message at once*)
	END_VAR
END_FUNCTION

FUNCTION cRosApiRegisterSubscriber : UDINT (*returns the handle of the subscriber, 0 for an unknown type or name*)
	VAR_INPUT
		node : UDINT;
		topic_name : STRING[CROS_NAME_LENGTH];
		topic_type : STRING[CROS_NAME_LENGTH];
		queue_size : UINT; (*messages that wait; the oldest is dropped*)
	END_VAR
END_FUNCTION

FUNCTION cRosApiRegisterServiceProvider : UDINT (*returns the handle of the provider, 0 for an unknown type or name*)
	VAR_INPUT
		node : UDINT;
		service_name : STRING[CROS_NAME_LENGTH];
		service_type : STRING[CROS_NAME_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosApiRegisterServiceCaller : UDINT (*returns the handle of the caller, 0 for an unknown type or name*)
	VAR_INPUT
		node : UDINT;
		service_name : STRING[CROS_NAME_LENGTH];
		service_type : STRING[CROS_NAME_LENGTH];
		persistent : BOOL; (*keep the connection from call to call*)
	END_VAR
END_FUNCTION

FUNCTION cRosApiSubscribeParam : UDINT (*returns the handle of the parameter, 0 for a name that is none*)
	VAR_INPUT
		node : UDINT;
		key : STRING[CROS_NAME_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosApiUnregister : UINT (*takes any of these back*)
	VAR_INPUT
		handle : UDINT;
	END_VAR
END_FUNCTION

(* Messages *)

FUNCTION cRosNextMsg : UDINT (*the message that is next: to fill for a publisher, received by a subscriber, the request of a provider, the reply of a caller; 0 where there is none*)
	VAR_INPUT
		handle : UDINT; (*publisher, subscriber, provider or caller*)
	END_VAR
END_FUNCTION

FUNCTION cRosNewMsg : UDINT (*a message with defaults: of a publisher's topic, the response to a request, the request of a caller*)
	VAR_INPUT
		handle : UDINT; (*publisher, caller, or a request of a provider*)
	END_VAR
END_FUNCTION

FUNCTION cRosSendMsg : UINT (*sends a message, calls with a request, answers with a response*)
	VAR_INPUT
		handle : UDINT; (*publisher, caller, or a request of a provider*)
		msg : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosServiceFail : UINT (*answers a request with an error*)
	VAR_INPUT
		msg : UDINT; (*the request*)
		reason : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosMsgError : UINT (*0 where a reply is a response; crosERR_REFUSED where an error came in its place*)
	VAR_INPUT
		msg : UDINT; (*the reply*)
		pReason : UDINT; (*address of the STRING that takes the error, 0 for none*)
		sizeReason : UDINT; (*its bytes*)
	END_VAR
END_FUNCTION

FUNCTION cRosMessageFree : UINT (*releases a message that is not sent*)
	VAR_INPUT
		msg : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosQueueDropped : UDINT (*messages that were dropped since the start*)
	VAR_INPUT
		handle : UDINT; (*publisher or subscriber*)
	END_VAR
END_FUNCTION

FUNCTION cRosPeers : UINT (*subscribers or publishers that are connected*)
	VAR_INPUT
		handle : UDINT; (*publisher or subscriber*)
	END_VAR
END_FUNCTION

(* A whole message as the STRUCT that plcsim types from-ros makes of its type *)

FUNCTION cRosMessageToStruct : UINT (*fills the STRUCT; lists and texts are cut to its bounds and counted*)
	VAR_INPUT
		msg : UDINT;
		pStruct : UDINT; (*its address*)
		sizeStruct : UDINT; (*its bytes*)
	END_VAR
END_FUNCTION

FUNCTION cRosMessageFromStruct : UINT (*fills the message*)
	VAR_INPUT
		msg : UDINT;
		pStruct : UDINT; (*its address*)
		sizeStruct : UDINT; (*its bytes*)
	END_VAR
END_FUNCTION

(* A message field by field *)

FUNCTION cRosMessageGetField : UDINT (*the field of a name, such as header.stamp or points[3].positions; 0 where there is none*)
	VAR_INPUT
		msg : UDINT;
		field : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosMessageGetFieldType : CrosMessageType (*type of a field, of an element where it is an array*)
	VAR_INPUT
		field : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageGetArraySize : DINT (*elements of an array, -1 for a field that is none*)
	VAR_INPUT
		field : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageSetArraySize : UINT (*makes an array without fixed length so long*)
	VAR_INPUT
		field : UDINT;
		size : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageGetFieldInt : LINT (*an integer or a BOOL; of an array the element of an index*)
	VAR_INPUT
		field : UDINT;
		index : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageGetFieldReal : LREAL (*any number*)
	VAR_INPUT
		field : UDINT;
		index : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageGetFieldString : UINT (*a text, cut to the STRING that takes it*)
	VAR_INPUT
		field : UDINT;
		index : UDINT;
		pValue : UDINT; (*address of the STRING*)
		sizeValue : UDINT; (*its bytes*)
	END_VAR
END_FUNCTION

FUNCTION cRosMessageSetFieldInt : UINT
	VAR_INPUT
		field : UDINT;
		index : UDINT;
		value : LINT;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageSetFieldReal : UINT
	VAR_INPUT
		field : UDINT;
		index : UDINT;
		value : LREAL;
	END_VAR
END_FUNCTION

FUNCTION cRosMessageSetFieldValueString : UINT (*name of figure 1.22*)
	VAR_INPUT
		field : UDINT;
		index : UDINT;
		value : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

(* Parameters *)

FUNCTION cRosParamInt : LINT (*value of a followed parameter, 0 where it is none*)
	VAR_INPUT
		param : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosParamReal : LREAL
	VAR_INPUT
		param : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosParamString : UINT (*a text, cut to the STRING that takes it*)
	VAR_INPUT
		param : UDINT;
		pValue : UDINT; (*address of the STRING*)
		sizeValue : UDINT; (*its bytes*)
	END_VAR
END_FUNCTION

FUNCTION cRosParamChanged : BOOL (*TRUE once for each change*)
	VAR_INPUT
		param : UDINT;
	END_VAR
END_FUNCTION

{REDUND_UNREPLICABLE} FUNCTION_BLOCK cRosApiSetParam (*sets a parameter; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		node : UDINT;
		key : STRING[CROS_NAME_LENGTH];
		value : STRING[CROS_TEXT_LENGTH]; (*a number, true, false, JSON, or a text*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or crosERR_...*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_call : UDINT; (*the call to the master that is under way*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_UNREPLICABLE} FUNCTION_BLOCK cRosApiGetParam (*asks for a parameter; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		node : UDINT;
		key : STRING[CROS_NAME_LENGTH];
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or crosERR_...*)
		value : STRING[CROS_TEXT_LENGTH]; (*as JSON*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_call : UDINT; (*the call to the master that is under way*)
	END_VAR
END_FUNCTION_BLOCK

(* Actions, as actionlib has them. Server and client do their part in cRosNodeDoEventsLoop. The handle of
   a server's goal is good until the goal is ended; that of a client's goal until it is released or a
   hundred newer ones were sent. *)

FUNCTION cRosActionServer : UDINT (*returns the handle of a server, in INIT; 0 for an unknown type or name*)
	VAR_INPUT
		node : UDINT;
		action_name : STRING[CROS_NAME_LENGTH];
		action_type : STRING[CROS_NAME_LENGTH]; (*such as control_msgs/FollowJointTrajectory*)
	END_VAR
END_FUNCTION

FUNCTION cRosActionClient : UDINT (*returns the handle of a client, in INIT; 0 for an unknown type or name*)
	VAR_INPUT
		node : UDINT;
		action_name : STRING[CROS_NAME_LENGTH];
		action_type : STRING[CROS_NAME_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosActionNextGoal : UDINT (*the oldest goal that is neither accepted nor rejected; 0 where there is none*)
	VAR_INPUT
		server : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionGoalMsg : UDINT (*the message of a server's goal, for cRosMessageToStruct or cRosMessageGetField*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionAccept : UINT (*begins a goal: it is ACTIVE, or PREEMPTING where it was cancelled before*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionNewFeedback : UDINT (*a feedback message with defaults*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionSendFeedback : UINT (*sends it; the message is released*)
	VAR_INPUT
		goal : UDINT;
		msg : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionNewResult : UDINT (*a result message with defaults*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionEnd : UINT (*ends a server's goal and releases it, where its state allows that*)
	VAR_INPUT
		goal : UDINT;
		state : CrosGoalState; (*SUCCEEDED, ABORTED, REJECTED or PREEMPTED (also RECALLED)*)
		msg : UDINT; (*the result, which is released; 0 for one of defaults*)
		text : STRING[CROS_TEXT_LENGTH]; (*for people*)
	END_VAR
END_FUNCTION

FUNCTION cRosActionConnected : BOOL (*a server hears the client, and is heard*)
	VAR_INPUT
		client : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionNewGoal : UDINT (*a goal message with defaults*)
	VAR_INPUT
		client : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionSendGoal : UDINT (*sends it and releases the message; returns the handle of the goal, 0 where a field cannot hold its value*)
	VAR_INPUT
		client : UDINT;
		msg : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionCancel : UINT (*asks the server to stop a client's goal*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionState : CrosGoalState (*how far a goal is, of server or client*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionText : UINT (*what the server says beside the state of a client's goal*)
	VAR_INPUT
		goal : UDINT;
		pText : UDINT; (*address of the STRING*)
		sizeText : UDINT; (*its bytes*)
	END_VAR
END_FUNCTION

FUNCTION cRosActionNextFeedback : UDINT (*the newest feedback of a client's goal, once; 0 where none is new*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionResult : UDINT (*the result of a client's goal, 0 before it is there*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosActionRelease : UINT (*forgets a client's goal, which goes on*)
	VAR_INPUT
		goal : UDINT;
	END_VAR
END_FUNCTION

(* Frames, as tf2 has them *)

FUNCTION cRosTfBroadcaster : UDINT (*returns the handle of what tells frames, in INIT*)
	VAR_INPUT
		node : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosTfBroadcast : UINT (*tells with the next cRosTfSend where a frame is in this cycle*)
	VAR_INPUT
		broadcaster : UDINT;
		parent : STRING[CROS_NAME_LENGTH];
		child : STRING[CROS_NAME_LENGTH];
	END_VAR
	VAR_IN_OUT
		transform : CrosTransform; (*from the child to the parent*)
	END_VAR
END_FUNCTION

FUNCTION cRosTfSend : UINT (*sends what was told, in one message*)
	VAR_INPUT
		broadcaster : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosTfStatic : UINT (*tells where a frame is for good; the first one in INIT*)
	VAR_INPUT
		broadcaster : UDINT;
		parent : STRING[CROS_NAME_LENGTH];
		child : STRING[CROS_NAME_LENGTH];
	END_VAR
	VAR_IN_OUT
		transform : CrosTransform;
	END_VAR
END_FUNCTION

FUNCTION cRosTfListener : UDINT (*returns the handle of what follows /tf and /tf_static, in INIT*)
	VAR_INPUT
		node : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosTfLookup : UINT (*looks up the transform from source to target; crosERR_NO_TRANSFORM where there is none*)
	VAR_INPUT
		listener : UDINT;
		target : STRING[CROS_NAME_LENGTH];
		source : STRING[CROS_NAME_LENGTH];
		time_ns : LINT; (*ROS time, 0 for the newest that all frames have*)
	END_VAR
	VAR_IN_OUT
		transform : CrosTransform;
	END_VAR
END_FUNCTION

(* Diagnostics: told once a second, and when a level changes *)

FUNCTION cRosDiagnostics : UDINT (*returns the handle of a node's diagnostics, in INIT*)
	VAR_INPUT
		node : UDINT;
		hardware_id : STRING[CROS_NAME_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosDiagnosticsValue : UINT (*a measured value of a component, told with its next cRosDiagnosticsSet and from then on*)
	VAR_INPUT
		diagnostics : UDINT;
		component : STRING[CROS_NAME_LENGTH];
		key : STRING[CROS_NAME_LENGTH];
		value : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosDiagnosticsSet : UINT (*says how a component is*)
	VAR_INPUT
		diagnostics : UDINT;
		component : STRING[CROS_NAME_LENGTH];
		level : CrosDiagnosticLevel;
		text : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

(* Values that others may change by dynamic_reconfigure; a node's are all declared in INIT *)

FUNCTION cRosAdjustable : UDINT (*declares a value; returns its handle, 0 where it is beyond its bounds or its name is taken*)
	VAR_INPUT
		node : UDINT;
		name : STRING[CROS_NAME_LENGTH];
		kind : CrosAdjustableKind;
		value : LREAL; (*at first*)
		minimum : LREAL;
		maximum : LREAL;
		description : STRING[CROS_TEXT_LENGTH];
	END_VAR
END_FUNCTION

FUNCTION cRosAdjustableValue : LREAL (*as it is now*)
	VAR_INPUT
		adjustable : UDINT;
	END_VAR
END_FUNCTION

FUNCTION cRosAdjustableSet : UINT (*changes it from the program, and tells those who follow it*)
	VAR_INPUT
		adjustable : UDINT;
		value : LREAL; (*cut to the bounds*)
	END_VAR
END_FUNCTION
