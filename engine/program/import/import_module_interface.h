/* What the program and the module libtessera_import agree on: C, so that neither needs the other to be
 * linked. */
#ifndef TESSERA_ENGINE_IMPORT_IMPORT_MODULE_INTERFACE_H
#define TESSERA_ENGINE_IMPORT_IMPORT_MODULE_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Takes bytes; called once. */
typedef void tessera_import_take_function(void* user, const unsigned char* bytes, size_t count);

/* Each function returns 0, or 1 and a reason in `message` (cut to message_size, always ended), or 2: there is
 * not enough memory. */

/* Reads a model file; the bytes are those of model_bytes.h. */
typedef int tessera_import_function(const char* path, tessera_import_take_function* take, void* user,
                                    char* message, size_t message_size);

/* The endings of the formats that can be read, with commas between. */
typedef int tessera_import_formats_function(tessera_import_take_function* take, void* user, char* message,
                                            size_t message_size);

/* The numbers change with the signatures, and with what the bytes are. */
#define TESSERA_IMPORT_NAME "tessera_import_2"
#define TESSERA_IMPORT_FORMATS_NAME "tessera_import_formats_1"
#define TESSERA_IMPORT_FILE_NAME "libtessera_import.so." TESSERA_SOVERSION

#ifdef __cplusplus
}
#endif

#endif
