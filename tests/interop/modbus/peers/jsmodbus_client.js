// Reads and writes programs/tank with jsmodbus.
const assert = require("assert");
const net = require("net");
const modbus = require("jsmodbus");

const socket = new net.Socket();
const client = new modbus.client.TCP(socket, 1, 2000);

async function main() {
  const level = await client.readInputRegisters(1, 2);
  const bytes = level.response.body.valuesAsBuffer;
  console.log(`level ${bytes.readFloatBE(0).toFixed(2)} m`);
  await client.writeSingleRegister(4, 66);
  const speed = await client.readHoldingRegisters(4, 1);
  assert.strictEqual(speed.response.body.valuesAsArray[0], 66);
  await client.writeSingleCoil(2, true);
  const coils = await client.readCoils(2, 1);
  assert.strictEqual(coils.response.body.valuesAsArray[0], 1);
  const setpoint = Buffer.alloc(4);
  setpoint.writeFloatBE(3.5);
  await client.writeMultipleRegisters(0, setpoint);
  const read = await client.readHoldingRegisters(0, 2);
  assert.strictEqual(read.response.body.valuesAsBuffer.readFloatBE(0), 3.5);
  await client.writeMultipleCoils(1, [false, false]);
  const inputs = await client.readDiscreteInputs(0, 5);
  console.log(`alarms ${inputs.response.body.valuesAsArray.slice(2, 5)}`);
  await assert.rejects(client.writeSingleRegister(4, 101), (e) => e.response.body.code === 3);
  console.log("SUCCESS");
  socket.end();
}

socket.on("connect", () => main().catch((error) => {
  console.error(error);
  process.exit(1);
}));
socket.connect({ host: "127.0.0.1", port: Number(process.argv[2]) });
