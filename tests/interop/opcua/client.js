// Acts as an HMI: node client.js ENDPOINT SECURITY USER PASSWORD; prints one line of JSON.
// Browses the project, reads, subscribes, writes a set point and sees it come back.
const {
  AttributeIds, ClientSubscription, ClientMonitoredItem, DataType, MessageSecurityMode, OPCUAClient,
  SecurityPolicy, TimestampsToReturn, UserTokenType, coerceNodeId,
} = require("node-opcua-client");

async function main() {
  const [endpoint, security, userName, password] = process.argv.slice(2);
  const isSecure = security !== "None";
  const client = OPCUAClient.create({
    endpointMustExist: false,
    securityPolicy: SecurityPolicy[security],
    securityMode: isSecure ? MessageSecurityMode.SignAndEncrypt : MessageSecurityMode.None,
    connectionStrategy: { maxRetry: 1, initialDelay: 200 },
  });
  await client.connect(endpoint);
  const session = await client.createSession(
    userName ? { type: UserTokenType.UserName, userName, password } : undefined);
  const result = {};

  const namespaces = await session.readNamespaceArray();
  const index = namespaces.indexOf("urn:plcsim:tank");
  const id = (path) => coerceNodeId(`ns=${index};s=${path}`);
  const browsed = await session.browse(id("::control"));
  result.control = browsed.references.map((reference) => reference.browseName.name);

  const level = await session.read({ nodeId: id("control.level"), attributeId: AttributeIds.Value });
  result.level = [DataType[level.value.dataType], level.value.value, level.statusCode.name];
  const unit = await session.read({ nodeId: id("control.level.EngineeringUnits"), attributeId: AttributeIds.Value });
  result.unit = unit.value.value && unit.value.value.displayName.text;

  const subscription = ClientSubscription.create(session, {
    requestedPublishingInterval: 50, requestedLifetimeCount: 100, requestedMaxKeepAliveCount: 10,
    maxNotificationsPerPublish: 100, publishingEnabled: true, priority: 1,
  });
  const seen = [];
  const item = ClientMonitoredItem.create(subscription,
    { nodeId: id("control.setpoint"), attributeId: AttributeIds.Value },
    { samplingInterval: 20, discardOldest: true, queueSize: 10 }, TimestampsToReturn.Both);
  const done = new Promise((resolve) => item.on("changed", (value) => {
    seen.push(value.value.value);
    if (value.value.value === 6.5) resolve();
  }));
  await new Promise((resolve) => item.on("initialized", resolve));

  const write = async (path, dataType, value) => {
    const code = await session.write({ nodeId: id(path), attributeId: AttributeIds.Value,
      value: { value: { dataType, value } } });
    return code.name;
  };
  result.written = await write("control.setpoint", DataType.Float, 6.5);
  result.mistyped = await write("control.setpoint", DataType.Double, 6.5);
  result.constant = await write("FULL_SCALE", DataType.Int16, 1);
  if (result.written === "Good") await done;
  result.seen = seen;
  await subscription.terminate();
  await session.close();
  await client.disconnect();
  console.log(JSON.stringify(result));
}

main().catch((error) => { console.log(JSON.stringify({ error: error.message })); process.exit(1); });
