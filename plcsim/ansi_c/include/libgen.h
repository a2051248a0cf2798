/* Parts of paths (POSIX). */

#ifndef PLCSIM_LIBGEN_H
#define PLCSIM_LIBGEN_H

#ifdef __cplusplus
extern "C" {
#endif

char *basename(char *path);
char *dirname(char *path);

#ifdef __cplusplus
}
#endif

#endif
