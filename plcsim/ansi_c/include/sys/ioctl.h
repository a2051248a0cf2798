/* Devices and sockets of POSIX, of which there are none. */

#ifndef PLCSIM_SYS_IOCTL_H
#define PLCSIM_SYS_IOCTL_H

#ifdef __cplusplus
extern "C" {
#endif

#define FIONREAD 0x541B
#define FIONBIO 0x5421

int ioctl(int file, unsigned long request, ...)
	__attribute__((diagnose_if(1, "a controller has no devices and sockets of POSIX: ioctl fails", "warning")));

#ifdef __cplusplus
}
#endif

#endif
