/* cROS' names for programs in C, on the node of CrosNode.fun: a cROS program is ported by making INIT,
 * CYCLIC and EXIT of its main (figures 1.19 to 1.22 of the thesis).
 *
 * What cROS does by callbacks is inverted as in figure 1.21: cRosNodeDoEventsLoop does one bounded
 * step, packets that are due wait in `node->pubs[i].queue_pubs`, pop() takes one, and
 * cRosMessageSerialize() sends it. Received messages wait in `node->subs[i].queue_subs` likewise, one
 * in each step, and requests of services in `node->services[i].queue_services`, with the request in
 * `.request` and the response to fill in `.response`; replies to own calls in
 * `node->service_callers[i].queue_replies`. Who wants all that has come in one cycle asks by
 * cRosNodeReceiveTopicMsg() until it gives something else than 0. The numbers of publishers and
 * subscribers count from 1, as the 0 of cROS is its own /rosout; those of services from 0.
 *
 * A field holds its value in `data`, as it was when cRosMessageGetField() gave it; what a program
 * changes there goes into the message when that is sent. Arrays are read and written by
 * cRosMessageFieldArrayAt...() and cRosMessageFieldArrayPushBack...().
 *
 * Master, host and message definitions are those of [ros] in plc.toml; cROS' arguments for them are
 * taken and not used. */

#ifndef CROS_API_H
#define CROS_API_H

#include <CrosNode.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define CN_MAX_PUBLISHED_TOPICS 5
#define CN_MAX_SUBSCRIBED_TOPICS 5
#define CN_MAX_SERVICE_PROVIDERS 8
#define CN_MAX_SERVICE_CALLERS 8
#define CN_MAX_FIELDS 32 /* of messages, that a program has in hand at one time */
#define CN_MAX_TEXT 256 /* bytes of a text in a field that was received */

/* CrosNode.typ has types of these names, which are those of the thesis for Structured Text. */
#define cRosMessage cros_cRosMessage
#define DynBuffer cros_DynBuffer
#define cRosMessageField cros_cRosMessageField
#define PublisherNode cros_PublisherNode
#define SubscriberNode cros_SubscriberNode
#define CrosNode cros_CrosNode
#define ServiceProviderNode cros_ServiceProviderNode
#define ServiceCallerNode cros_ServiceCallerNode
#define CallbackResponse UINT

typedef struct cRosMessage {
	UDINT handle;
	const char *path; /* of a message in another one, "pose.position."; NULL for a whole one */
} cRosMessage;

/* A packet of a topic: what cRosMessageSerialize() fills and sends. */
typedef struct DynBuffer {
	UDINT topic; /* or the request that is answered */
	cRosMessage *message;
} DynBuffer;

typedef union cros_field_data {
	int8_t as_int8;
	uint8_t as_uint8;
	int16_t as_int16;
	uint16_t as_uint16;
	int32_t as_int32;
	uint32_t as_uint32;
	int64_t as_int64;
	uint64_t as_uint64;
	float as_float32;
	double as_float64;
	char *as_string;
	cRosMessage *as_msg;
} cros_field_data;

typedef struct cRosMessageField {
	UDINT handle;
	UDINT message; /* that it belongs to */
	CrosMessageType type;
	unsigned char is_array;
	int size; /* of a text in bytes, of an array in elements */
	cros_field_data data;
	cros_field_data given; /* what `data` was at first */
	cRosMessage inner;
	char text[CN_MAX_TEXT];
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

/* A service that the node provides: a request, and the response to it, which is to be filled. */
typedef struct ServiceProviderNode {
	UDINT handle;
	cRosMessage *request, *response;
	DynBuffer *queue_services; /* NULL while nothing is asked */
	cRosMessage asked, answer;
	DynBuffer packet;
} ServiceProviderNode;

typedef struct ServiceCallerNode {
	UDINT handle;
	cRosMessage *response;
	DynBuffer *queue_replies; /* NULL while no reply has come */
	cRosMessage reply;
	DynBuffer packet;
} ServiceCallerNode;

typedef struct CrosNode {
	UDINT handle;
	PublisherNode pubs[CN_MAX_PUBLISHED_TOPICS];
	SubscriberNode subs[CN_MAX_SUBSCRIBED_TOPICS];
	ServiceProviderNode services[CN_MAX_SERVICE_PROVIDERS];
	ServiceCallerNode service_callers[CN_MAX_SERVICE_CALLERS];
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

static void cros_step_service(ServiceProviderNode *service)
{
	if (!service->handle || service->queue_services)
		return;
	service->asked.handle = cRosNextMsg(service->handle);
	if (!service->asked.handle)
		return;
	service->answer.handle = cRosNewMsg(service->asked.handle);
	service->request = &service->asked;
	service->response = &service->answer;
	service->packet.topic = service->asked.handle;
	service->packet.message = &service->answer;
	service->queue_services = &service->packet;
}

static void cros_step_caller(ServiceCallerNode *caller)
{
	if (!caller->handle || caller->queue_replies)
		return;
	if (caller->reply.handle)
		cRosMessageFree(caller->reply.handle);
	caller->reply.handle = cRosNextMsg(caller->handle);
	caller->response = &caller->reply;
	caller->packet.message = &caller->reply;
	if (caller->reply.handle)
		caller->queue_replies = &caller->packet;
}

/* Does one step of the node, then tells which packets are due and which messages have come. */
static UINT cros_node_do_events_loop(CrosNode *node)
{
	UINT status = cRosNodeDoEventsLoop(node->handle);
	for (int i = 1; i < CN_MAX_PUBLISHED_TOPICS; i++)
		cros_step_publisher(&node->pubs[i]);
	for (int i = 1; i < CN_MAX_SUBSCRIBED_TOPICS; i++)
		cros_step_subscriber(&node->subs[i]);
	for (int i = 0; i < CN_MAX_SERVICE_PROVIDERS; i++)
		cros_step_service(&node->services[i]);
	for (int i = 0; i < CN_MAX_SERVICE_CALLERS; i++)
		cros_step_caller(&node->service_callers[i]);
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

/* Returns the number of the service, -1 for an unknown type or where there is no room. */
static int cros_api_register_provider(CrosNode *node, const char *service, const char *type)
{
	for (int i = 0; i < CN_MAX_SERVICE_PROVIDERS; i++)
		if (!node->services[i].handle) {
			node->services[i].handle =
				cRosApiRegisterServiceProvider(node->handle, (char *)service, (char *)type);
			return node->services[i].handle ? i : -1;
		}
	return -1;
}

/* Returns the number of the caller, -1 likewise. */
static int cros_api_register_caller(CrosNode *node, const char *service, const char *type)
{
	for (int i = 0; i < CN_MAX_SERVICE_CALLERS; i++)
		if (!node->service_callers[i].handle) {
			node->service_callers[i].handle =
				cRosApiRegisterServiceCaller(node->handle, (char *)service, (char *)type, 0);
			return node->service_callers[i].handle ? i : -1;
		}
	return -1;
}

static cRosMessageField cros_fields[CN_MAX_FIELDS];

/* Brings the value of a field into its union, or back into the message. */
static int cros_move_field(cRosMessageField *field, int is_back)
{
#define CROS_WHOLE(type, member) \
	case type: \
		if (is_back) \
			return cRosMessageSetFieldInt(field->handle, 0, (LINT)field->data.member); \
		field->data.member = cRosMessageGetFieldInt(field->handle, 0); \
		return 0;
#define CROS_REAL(type, member) \
	case type: \
		if (is_back) \
			return cRosMessageSetFieldReal(field->handle, 0, (LREAL)field->data.member); \
		field->data.member = cRosMessageGetFieldReal(field->handle, 0); \
		return 0;
	switch (field->type) {
	CROS_WHOLE(CROS_STD_MSGS_INT8, as_int8)
	CROS_WHOLE(CROS_STD_MSGS_BYTE, as_int8)
	CROS_WHOLE(CROS_STD_MSGS_UINT8, as_uint8)
	CROS_WHOLE(CROS_STD_MSGS_CHAR, as_uint8)
	CROS_WHOLE(CROS_STD_MSGS_BOOL, as_uint8)
	CROS_WHOLE(CROS_STD_MSGS_INT16, as_int16)
	CROS_WHOLE(CROS_STD_MSGS_UINT16, as_uint16)
	CROS_WHOLE(CROS_STD_MSGS_INT32, as_int32)
	CROS_WHOLE(CROS_STD_MSGS_UINT32, as_uint32)
	CROS_WHOLE(CROS_STD_MSGS_INT64, as_int64)
	CROS_WHOLE(CROS_STD_MSGS_UINT64, as_uint64)
	CROS_REAL(CROS_STD_MSGS_FLOAT32, as_float32)
	CROS_REAL(CROS_STD_MSGS_FLOAT64, as_float64)
	case CROS_STD_MSGS_STRING:
		if (is_back)
			return cRosMessageSetFieldValueString(field->handle, 0, field->data.as_string);
		field->text[0] = 0;
		cRosMessageGetFieldString(field->handle, 0, (UDINT)field->text, sizeof field->text);
		field->data.as_string = field->text;
		field->size = (int)strlen(field->text);
		return 0;
	default:
		return 0;
	}
#undef CROS_WHOLE
#undef CROS_REAL
}

/* Makes the message in a field: it is the outer one, with a path. */
static void cros_enter_message(cRosMessageField *field, const char *path)
{
	snprintf(field->text, sizeof field->text, "%s.", path);
	field->inner.handle = field->message;
	field->inner.path = field->text;
	field->data.as_msg = &field->inner;
}

/* Returns a field, NULL where there is none of this name; it is good for the next CN_MAX_FIELDS. */
static cRosMessageField *cros_message_get_field(cRosMessage *message, const char *name)
{
	static unsigned next;
	char path[CN_MAX_TEXT];
	int length = snprintf(path, sizeof path, "%s%s", message->path ? message->path : "", name);
	UDINT handle = cRosMessageGetField(message->handle, path);
	if (!handle || length > CN_MAX_TEXT - 2)
		return NULL;
	cRosMessageField *field = &cros_fields[next++ % CN_MAX_FIELDS];
	memset(field, 0, sizeof *field);
	field->handle = handle;
	field->message = message->handle;
	field->type = cRosMessageGetFieldType(handle);
	DINT elements = cRosMessageGetArraySize(handle);
	field->is_array = elements >= 0;
	if (field->is_array)
		field->size = elements;
	else if (field->type == CROS_CUSTOM_TYPE || field->type == CROS_STD_MSGS_HEADER)
		cros_enter_message(field, path);
	else
		cros_move_field(field, 0);
	field->given = field->data;
	return field;
}

/* Returns 0, or what cRosMessageSetFieldValueString of CrosNode.fun refuses it with. */
static int cros_message_set_string(cRosMessageField *field, const char *value)
{
	field->given.as_string = field->data.as_string = (char *)value;
	field->size = (int)strlen(value);
	return cRosMessageSetFieldValueString(field->handle, 0, (char *)value);
}

/* Puts what was changed in fields of a message into it, and forgets them. */
static int cros_message_complete(cRosMessage *message)
{
	int status = 0;
	for (int i = 0; i < CN_MAX_FIELDS; i++) {
		cRosMessageField *field = &cros_fields[i];
		if (!field->handle || field->message != message->handle)
			continue;
		if (!field->is_array && memcmp(&field->data, &field->given, sizeof field->data)) {
			int refused = cros_move_field(field, 1);
			status = status ? status : refused;
		}
		field->handle = 0;
	}
	return status;
}

/* Sends a message, calls with it or answers by it; 0, or a status of CrosNode.fun. */
static int cros_message_send(UDINT to, cRosMessage *message)
{
	int status = cros_message_complete(message);
	if (!status)
		status = cRosSendMsg(to, message->handle);
	message->handle = 0;
	return status;
}

/* Fills a packet with a message: it is sent, or answers the request. */
static int cros_message_serialize(cRosMessage *message, DynBuffer *buffer)
{
	return cros_message_send(buffer->topic, message);
}

/* Gives the next message that has come; 0, or 1 where there is none. */
static int cros_node_receive(CrosNode *node, int number, cRosMessage *message, UDINT *dropped)
{
	SubscriberNode *subscriber = &node->subs[number];
	if (subscriber->queue_subs) {
		*message = *subscriber->queue_subs->message;
		subscriber->message.handle = 0;
		subscriber->queue_subs = NULL;
	} else {
		*message = (cRosMessage){cRosNextMsg(subscriber->handle), NULL};
	}
	if (dropped)
		*dropped = cRosQueueDropped(subscriber->handle);
	return !message->handle;
}

/* Elements of arrays: 0, or a status of CrosNode.fun. */
#define CROS_ARRAY(name, type, kind, wide) \
	static int cRosMessageFieldArrayAt##name(cRosMessageField *field, int at, type *value) \
	{ \
		if (at < 0 || at >= cRosMessageGetArraySize(field->handle)) \
			return crosERR_FIELD; \
		*value = (type)cRosMessageGetField##kind(field->handle, (UDINT)at); \
		return 0; \
	} \
	static int cRosMessageFieldArrayPushBack##name(cRosMessageField *field, type value) \
	{ \
		DINT size = cRosMessageGetArraySize(field->handle); \
		int status = cRosMessageSetArraySize(field->handle, (UDINT)size + 1); \
		if (!status) \
			status = cRosMessageSetField##kind(field->handle, (UDINT)size, (wide)value); \
		field->size = cRosMessageGetArraySize(field->handle); \
		return status; \
	}
CROS_ARRAY(Int8, int8_t, Int, LINT)
CROS_ARRAY(UInt8, uint8_t, Int, LINT)
CROS_ARRAY(Int16, int16_t, Int, LINT)
CROS_ARRAY(UInt16, uint16_t, Int, LINT)
CROS_ARRAY(Int32, int32_t, Int, LINT)
CROS_ARRAY(UInt32, uint32_t, Int, LINT)
CROS_ARRAY(Int64, int64_t, Int, LINT)
CROS_ARRAY(UInt64, uint64_t, Int, LINT)
CROS_ARRAY(Float32, float, Real, LREAL)
CROS_ARRAY(Float64, double, Real, LREAL)
#undef CROS_ARRAY

static int cRosMessageFieldArrayPushBackString(cRosMessageField *field, const char *value)
{
	DINT size = cRosMessageGetArraySize(field->handle);
	int status = cRosMessageSetArraySize(field->handle, (UDINT)size + 1);
	if (!status)
		status = cRosMessageSetFieldValueString(field->handle, (UDINT)size, (char *)value);
	field->size = cRosMessageGetArraySize(field->handle);
	return status;
}

static int cRosMessageFieldArrayClear(cRosMessageField *field)
{
	field->size = 0;
	return cRosMessageSetArraySize(field->handle, 0);
}

/* A program uses some of them. */
#pragma clang diagnostic ignored "-Wunused-function"

#define cRosNodeCreate(name, ...) cros_node_create(name)
#define cRosNodeDoEventsLoop(node, ...) cros_node_do_events_loop(node)
#define cRosNodeDestroy(node) cros_node_destroy(node)
#define cRosApiRegisterPublisher(node, topic, type, loop_period, ...) \
	cros_api_register_publisher(node, topic, type, loop_period)
#define cRosApiRegisterSubscriber(node, topic, type, ...) cros_api_register_subscriber(node, topic, type)
#define cRosApiRegisterServiceProvider(node, service, type, ...) \
	cros_api_register_provider(node, service, type)
#define cRosApiRegisterServiceCaller(node, service, type, ...) \
	cros_api_register_caller(node, service, type)
#define cRosApiCreatePublisherMessage(node, number) \
	((cRosMessage){cRosNewMsg((node)->pubs[number].handle), NULL})
#define cRosApiCreateServiceCallerRequest(node, number) \
	((cRosMessage){cRosNewMsg((node)->service_callers[number].handle), NULL})
#define cRosNodeQueueTopicMsg(node, number, message) \
	cros_message_send((node)->pubs[number].handle, message)
#define cRosNodeQueueServiceCall(node, number, request) \
	cros_message_send((node)->service_callers[number].handle, request)
#define cRosNodeReceiveTopicMsg(node, number, message, dropped, ...) \
	cros_node_receive(node, number, message, dropped)
#define cRosMessageGetField(message, name) cros_message_get_field(message, name)
#define cRosMessageSetFieldValueString(field, value) cros_message_set_string(field, value)
#define cRosMessageSerialize(message, buffer) cros_message_serialize(message, buffer)

#endif
