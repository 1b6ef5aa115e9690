/* What the program and the module libtessera_imageio agree on: C, so that neither needs the other to be linked. */
#ifndef TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H
#define TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes RGBA pixels of 8 bits, rows from the top, as an image without alpha in the format of the path's ending.
   Returns 0, or 1 and a reason in `message` (cut to message_size, always ended). */
typedef int tessera_imageio_write_function(const char* path, const unsigned char* rgba, int width, int height, ptrdiff_t stride_bytes,
                                           char* message, size_t message_size);

#define TESSERA_IMAGEIO_WRITE_NAME "tessera_imageio_write_1" /* the number changes with the signature */
#define TESSERA_IMAGEIO_FILE_NAME "libtessera_imageio.so.0"

#ifdef __cplusplus
}
#endif

#endif
