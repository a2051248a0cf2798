// Reads and writes programs/tank with modbus-serial, five requests at a time as well.
const assert = require("assert");
const ModbusRTU = require("modbus-serial");

async function main(port) {
  const client = new ModbusRTU();
  await client.connectTCP("127.0.0.1", { port });
  client.setID(1);
  client.setTimeout(2000);

  const level = await client.readInputRegisters(1, 2);
  console.log(`level ${level.buffer.readFloatBE(0).toFixed(2)} m`);
  const together = await Promise.all([0, 1, 2, 3, 4].map((i) => client.readInputRegisters(i, 2)));
  assert.strictEqual(together.length, 5);
  console.log("5 concurrent reads answered");

  await client.writeRegister(4, 88);
  assert.deepStrictEqual((await client.readHoldingRegisters(4, 1)).data, [88]);
  await client.writeCoil(2, true);
  assert.strictEqual((await client.readCoils(2, 1)).data[0], true);
  await client.writeCoils(1, [false, false]);
  assert.deepStrictEqual((await client.readCoils(1, 2)).data.slice(0, 2), [false, false]);
  const setpoint = Buffer.alloc(4);
  setpoint.writeFloatBE(4.25);
  await client.writeRegisters(0, setpoint);
  assert.deepStrictEqual((await client.readHoldingRegisters(5, 1)).data, [425]);
  await client.maskWriteRegister(14, 0xfffb, 0x0004);
  assert.strictEqual((await client.readHoldingRegisters(14, 1)).data[0] & 4, 4);
  console.log("FC5, 6, 15, 16, 22 written and read back");

  const identification = await client.readDeviceIdentification(1, 0);
  console.log(`FC43/14 ${Object.values(identification.data).join(" ")}`);
  await assert.rejects(client.writeRegister(4, 101), /Illegal data value/);
  await assert.rejects(client.readHoldingRegisters(9000, 1), /Illegal data address/);
  console.log("SUCCESS");
  client.close(() => process.exit(0));
}

main(Number(process.argv[2])).catch((error) => {
  console.error(error);
  process.exit(1);
});
