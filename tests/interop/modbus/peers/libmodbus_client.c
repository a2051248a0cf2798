/* Reads and writes programs/tank with libmodbus; prints what it saw, exits with 1 at a surprise. */
#include <errno.h>
#include <modbus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPECT(condition)                                                          \
    do {                                                                           \
        if (!(condition)) {                                                        \
            printf("line %d: %s: %s\n", __LINE__, #condition, modbus_strerror(errno)); \
            exit(1);                                                               \
        }                                                                          \
    } while (0)

int main(int argc, char **argv)
{
    uint8_t bits[8];
    uint16_t registers[64];
    const uint8_t on[2] = {1, 0};
    modbus_t *bus = modbus_new_tcp("127.0.0.1", argc > 1 ? atoi(argv[1]) : 1502);

    EXPECT(bus != NULL);
    modbus_set_slave(bus, 17);
    EXPECT(modbus_connect(bus) == 0);

    EXPECT(modbus_read_bits(bus, 0, 4, bits) == 4);
    printf("FC1  automatic %d\n", bits[0]);
    EXPECT(modbus_read_input_bits(bus, 0, 5, bits) == 5);
    printf("FC2  alarm_high %d\n", bits[2]);
    EXPECT(modbus_read_registers(bus, 0, 2, registers) == 2);
    printf("FC3  setpoint %.2f m\n", modbus_get_float_abcd(registers));
    EXPECT(modbus_read_input_registers(bus, 1, 4, registers) == 4);
    printf("FC4  level %.2f m, low word first %.2f m\n", modbus_get_float_abcd(registers),
           modbus_get_float_cdab(registers + 2));
    EXPECT(modbus_get_float_abcd(registers) == modbus_get_float_cdab(registers + 2));

    EXPECT(modbus_write_bit(bus, 2, 1) == 1);
    EXPECT(modbus_read_bits(bus, 2, 1, bits) == 1 && bits[0] == 1);
    EXPECT(modbus_write_register(bus, 4, 77) == 1);
    EXPECT(modbus_read_registers(bus, 4, 1, registers) == 1 && registers[0] == 77);
    EXPECT(modbus_write_bits(bus, 1, 2, on) == 2);
    EXPECT(modbus_read_bits(bus, 1, 2, bits) == 2 && bits[0] == 1 && bits[1] == 0);
    registers[0] = 0x40B0; /* 5.5; modbus_set_float_abcd of 3.1.6 stores other bytes */
    registers[1] = 0x0000;
    EXPECT(modbus_write_registers(bus, 0, 2, registers) == 2);
    EXPECT(modbus_read_registers(bus, 0, 2, registers) == 2);
    EXPECT(modbus_get_float_abcd(registers) == 5.5f);
    EXPECT(modbus_mask_write_register(bus, 14, 0xFFFB, 0x0004) != -1);
    EXPECT(modbus_read_registers(bus, 14, 1, registers) == 1 && (registers[0] & 4));
    registers[0] = 33;
    EXPECT(modbus_write_and_read_registers(bus, 4, 1, registers, 4, 1, registers + 1) == 1);
    EXPECT(registers[1] == 33);
    printf("FC5, 6, 15, 16, 22, 23 written and read back\n");

    EXPECT(modbus_write_register(bus, 4, 101) == -1 && errno == EMBXILVAL);
    EXPECT(modbus_write_register(bus, 0, 1) == -1 && errno == EMBXILADD);
    EXPECT(modbus_read_registers(bus, 9000, 1, registers) == -1 && errno == EMBXILADD);
    printf("refused: out of range, half of a REAL, no such register\n");

    EXPECT(modbus_report_slave_id(bus, sizeof bits, bits) > 0);
    modbus_close(bus);
    modbus_free(bus);
    printf("SUCCESS\n");
    return 0;
}
