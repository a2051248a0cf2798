/* The listener in cROS' own names: takes all messages that have come, and tells /rosout of them. */

#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <cros_api.h>
#include <stdio.h>

static CrosNode *node;
static int chatter;

static void callback_hello(cRosMessage *message)
{
	char line[256];
	cRosMessageField *aWord = cRosMessageGetField(message, "aWord");
	strlcpy(word, aWord->data.as_string, sizeof word);
	heard++;
	snprintf(line, sizeof line, "I heard: [%s]", word);
	cRosLog(node->handle, CROS_LOGLEVEL_INFO, line);
}

void _INIT ProgramInit(void)
{
	node = cRosNodeCreate("/listener_cros", "127.0.0.1", "127.0.0.1", 11311, "/rosdb", NULL);
	chatter = cRosApiRegisterSubscriber(node, "/chatter", "prova/hello");
}

void _CYCLIC ProgramCyclic(void)
{
	cRosMessage message;
	cRosNodeDoEventsLoop(node);
	while (cRosNodeReceiveTopicMsg(node, chatter, &message, &lost, 0) == 0)
		callback_hello(&message);
	lost = cRosQueueDropped(node->subs[chatter].handle);
}

void _EXIT ProgramExit(void)
{
	cRosNodeDestroy(node);
}
