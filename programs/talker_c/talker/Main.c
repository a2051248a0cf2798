/* The talker of the thesis in cROS' own names (figures 1.19 to 1.22): its main in three units. */

#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <cros_api.h>

static CrosNode *node;

static CallbackResponse callback_hello(DynBuffer *buffer, cRosMessage *message)
{
	cRosMessageField *StringStatus_field = cRosMessageGetField(message, "aWord");
	cRosMessageSetFieldValueString(StringStatus_field, word);
	cRosMessageSerialize(message, buffer);
	sent++;
	return 0;
}

void _INIT ProgramInit(void)
{
	node = cRosNodeCreate("/talker_cros", "127.0.0.1", "127.0.0.1", 11311, "/rosdb", NULL);
	cRosApiRegisterPublisher(node, "/chatter", "prova/hello", 1000);
}

void _CYCLIC ProgramCyclic(void)
{
	int i;
	cRosNodeDoEventsLoop(node);

	for (i = 1; i < 4; ++i)
		while (node->pubs[i].queue_pubs != NULL)
			callback_hello(pop(&(node->pubs[i].queue_pubs)), node->pubs[i].msg);
	subscribers = cRosPeers(node->pubs[1].handle);
}

void _EXIT ProgramExit(void)
{
	cRosNodeDestroy(node);
}
