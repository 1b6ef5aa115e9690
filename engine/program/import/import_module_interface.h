/* Interface between the program and the module libtessera_import. It is plain C and loaded at run time, so
 * that the program does not link assimp. */
#ifndef TESSERA_ENGINE_IMPORT_IMPORT_MODULE_INTERFACE_H
#define TESSERA_ENGINE_IMPORT_IMPORT_MODULE_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives the bytes; called once. */
typedef void tessera_import_take_function(void* user, const unsigned char* bytes, size_t count);

/* Receives the share of the work that is done, 0 .. 1. It may end the process. */
typedef void tessera_import_progress_function(void* user, double done);

/* Each function returns
 *   0  success
 *   1  failure; `message` holds the reason, truncated to message_size and always terminated
 *   2  out of memory */

/* Reads a model file and delivers it in the format of model_bytes.h. */
typedef int tessera_import_function(const char* path, tessera_import_progress_function* progress,
                                    void* progress_user, tessera_import_take_function* take, void* user,
                                    char* message, size_t message_size);

/* Delivers the file name extensions of the readable formats, separated by commas. */
typedef int tessera_import_formats_function(tessera_import_take_function* take, void* user, char* message,
                                            size_t message_size);

/* The numbers change with the signatures and with the byte format. */
#define TESSERA_IMPORT_NAME "tessera_import_5"
#define TESSERA_IMPORT_FORMATS_NAME "tessera_import_formats_1"
#define TESSERA_IMPORT_FILE_NAME "libtessera_import.so." TESSERA_SOVERSION

#ifdef __cplusplus
}
#endif

#endif
