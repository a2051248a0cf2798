/* cROS' names for programs in C, on the node of CrosNode.fun: a cROS program is ported by making INIT,
 * CYCLIC and EXIT of its main (figures 1.19 to 1.22 of the thesis).
 *
 * What cROS does by callbacks is inverted as in figure 1.21: cRosNodeDoEventsLoop does one bounded
 * step, packets that are due wait in `node->pubs[i].queue_pubs`, pop() takes one, and
 * cRosMessageSerialize() sends it. Received messages wait in `node->subs[i].queue_subs` likewise. The
 * numbers of publishers and subscribers count from 1, as the 0 of cROS is its own /rosout.
 *
 * Master, host and message definitions are those of [ros] in plc.toml; cROS' arguments for them are
 * taken and not used. */

#ifndef CROS_API_H
#define CROS_API_H

#include <CrosNode.h>
#include <stddef.h>
#include <string.h>

#define CN_MAX_PUBLISHED_TOPICS 5
#define CN_MAX_SUBSCRIBED_TOPICS 5
#define CN_MAX_FIELDS 32 /* of messages, that a program has in hand at one time */

/* CrosNode.typ has types of these names, which are those of the thesis for Structured Text. */
#define cRosMessage cros_cRosMessage
#define DynBuffer cros_DynBuffer
#define cRosMessageField cros_cRosMessageField
#define PublisherNode cros_PublisherNode
#define SubscriberNode cros_SubscriberNode
#define CrosNode cros_CrosNode
#define CallbackResponse UINT

typedef struct cRosMessage {
	UDINT handle;
} cRosMessage;

/* A packet of a topic: what cRosMessageSerialize() fills and sends. */
typedef struct DynBuffer {
	UDINT topic;
	cRosMessage *message;
} DynBuffer;

typedef struct cRosMessageField {
	UDINT handle;
	int size;
	union {
		char *as_string;
	} data;
} cRosMessageField;

typedef struct PublisherNode {
	UDINT handle;
	cRosMessage *msg;
	DynBuffer *queue_pubs; /* NULL while nothing is due */
	cRosMessage message;
	DynBuffer packet;
} PublisherNode;

typedef struct SubscriberNode {
	UDINT handle;
	cRosMessage *msg;
	DynBuffer *queue_subs; /* NULL while nothing has come */
	cRosMessage message;
	DynBuffer packet;
} SubscriberNode;

typedef struct CrosNode {
	UDINT handle;
	PublisherNode pubs[CN_MAX_PUBLISHED_TOPICS];
	SubscriberNode subs[CN_MAX_SUBSCRIBED_TOPICS];
} CrosNode;

/* Returns the node of the program, NULL where no port can be opened. A program has one. */
static CrosNode *cros_node_create(const char *name)
{
	static CrosNode node;
	memset(&node, 0, sizeof node);
	node.handle = cRosNodeCreate((char *)name);
	return node.handle ? &node : NULL;
}

static void cros_step_publisher(PublisherNode *publisher)
{
	if (!publisher->handle || publisher->queue_pubs)
		return;
	publisher->message.handle = cRosNextMsg(publisher->handle);
	publisher->msg = &publisher->message;
	publisher->packet.topic = publisher->handle;
	publisher->packet.message = &publisher->message;
	if (publisher->message.handle)
		publisher->queue_pubs = &publisher->packet;
}

static void cros_step_subscriber(SubscriberNode *subscriber)
{
	if (!subscriber->handle || subscriber->queue_subs)
		return;
	if (subscriber->message.handle)
		cRosMessageFree(subscriber->message.handle);
	subscriber->message.handle = cRosNextMsg(subscriber->handle);
	subscriber->msg = &subscriber->message;
	subscriber->packet.message = &subscriber->message;
	if (subscriber->message.handle)
		subscriber->queue_subs = &subscriber->packet;
}

/* Does one step of the node, then tells which packets are due and which messages have come. */
static UINT cros_node_do_events_loop(CrosNode *node)
{
	UINT status = cRosNodeDoEventsLoop(node->handle);
	for (int i = 1; i < CN_MAX_PUBLISHED_TOPICS; i++)
		cros_step_publisher(&node->pubs[i]);
	for (int i = 1; i < CN_MAX_SUBSCRIBED_TOPICS; i++)
		cros_step_subscriber(&node->subs[i]);
	return status;
}

static UINT cros_node_destroy(CrosNode *node) { return cRosNodeDestroy(node->handle); }

/* Returns the number of the publisher, -1 for an unknown type or where there is no room. */
static int cros_api_register_publisher(
	CrosNode *node, const char *topic, const char *type, int loop_period)
{
	for (int i = 1; i < CN_MAX_PUBLISHED_TOPICS; i++)
		if (!node->pubs[i].handle) {
			node->pubs[i].handle =
				cRosApiRegisterPublisher(node->handle, (char *)topic, (char *)type, loop_period, 0);
			return node->pubs[i].handle ? i : -1;
		}
	return -1;
}

/* Returns the number of the subscriber, -1 for an unknown type or where there is no room. */
static int cros_api_register_subscriber(CrosNode *node, const char *topic, const char *type)
{
	for (int i = 1; i < CN_MAX_SUBSCRIBED_TOPICS; i++)
		if (!node->subs[i].handle) {
			node->subs[i].handle =
				cRosApiRegisterSubscriber(node->handle, (char *)topic, (char *)type, 10);
			return node->subs[i].handle ? i : -1;
		}
	return -1;
}

/* Takes the packet out of a queue. */
static inline DynBuffer *pop(DynBuffer **queue)
{
	DynBuffer *packet = *queue;
	*queue = NULL;
	return packet;
}

/* Returns a field, NULL where there is none of this name; it is good for the next CN_MAX_FIELDS. */
static cRosMessageField *cros_message_get_field(cRosMessage *message, const char *name)
{
	static cRosMessageField fields[CN_MAX_FIELDS];
	static unsigned next;
	cRosMessageField *field = &fields[next++ % CN_MAX_FIELDS];
	field->handle = cRosMessageGetField(message->handle, (char *)name);
	field->size = 0;
	field->data.as_string = NULL;
	return field->handle ? field : NULL;
}

/* Returns 0, or what cRosMessageSetFieldValueString of CrosNode.fun refuses it with. */
static int cros_message_set_string(cRosMessageField *field, const char *value)
{
	field->data.as_string = (char *)value;
	field->size = (int)strlen(value);
	return cRosMessageSetFieldValueString(field->handle, 0, (char *)value);
}

/* Fills a packet of a publisher with a message: it is sent. */
static int cros_message_serialize(cRosMessage *message, DynBuffer *buffer)
{
	UINT status = cRosSendMsg(buffer->topic, message->handle);
	message->handle = 0;
	return status;
}

/* A program uses some of them. */
#pragma clang diagnostic ignored "-Wunused-function"

#define cRosNodeCreate(name, ...) cros_node_create(name)
#define cRosNodeDoEventsLoop(node, ...) cros_node_do_events_loop(node)
#define cRosNodeDestroy(node) cros_node_destroy(node)
#define cRosApiRegisterPublisher(node, topic, type, loop_period, ...) \
	cros_api_register_publisher(node, topic, type, loop_period)
#define cRosApiRegisterSubscriber(node, topic, type, ...) cros_api_register_subscriber(node, topic, type)
#define cRosMessageGetField(message, name) cros_message_get_field(message, name)
#define cRosMessageSetFieldValueString(field, value) cros_message_set_string(field, value)
#define cRosMessageSerialize(message, buffer) cros_message_serialize(message, buffer)

#endif
