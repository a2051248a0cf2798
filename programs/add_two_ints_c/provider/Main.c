/* Provides /add_two_ints in cROS' own names: answers what was asked, and calls itself as well. */

#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <cros_api.h>

static CrosNode *node;
static int add, caller;

static void callback_add(DynBuffer *buffer, cRosMessage *request, cRosMessage *response)
{
	int64_t a = cRosMessageGetField(request, "a")->data.as_int64;
	int64_t b = cRosMessageGetField(request, "b")->data.as_int64;
	cRosMessageGetField(response, "sum")->data.as_int64 = a + b;
	cRosMessageSerialize(response, buffer);
	answered++;
}

static void call(void)
{
	cRosMessage request = cRosApiCreateServiceCallerRequest(node, caller);
	cRosMessageGetField(&request, "a")->data.as_int64 = answered;
	cRosMessageGetField(&request, "b")->data.as_int64 = 2;
	is_calling = cRosNodeQueueServiceCall(node, caller, &request) == 0;
}

void _INIT ProgramInit(void)
{
	node = cRosNodeCreate("/add_two_ints_server", "127.0.0.1", "127.0.0.1", 11311, "/rosdb", NULL);
	add = cRosApiRegisterServiceProvider(node, "/add_two_ints", "roscpp_tutorials/TwoInts");
	caller = cRosApiRegisterServiceCaller(node, "/add_two_ints", "roscpp_tutorials/TwoInts");
}

void _CYCLIC ProgramCyclic(void)
{
	cRosNodeDoEventsLoop(node);
	while (node->services[add].queue_services != NULL)
		callback_add(pop(&(node->services[add].queue_services)), node->services[add].request,
		             node->services[add].response);
	while (node->service_callers[caller].queue_replies != NULL) {
		DynBuffer *packet = pop(&(node->service_callers[caller].queue_replies));
		if (!cRosMsgError(packet->message->handle, 0, 0))
			last = (DINT)cRosMessageGetField(packet->message, "sum")->data.as_int64;
		is_calling = 0;
	}
	if (!is_calling && ++idle % 100 == 0)
		call();
}

void _EXIT ProgramExit(void)
{
	cRosNodeDestroy(node);
}
