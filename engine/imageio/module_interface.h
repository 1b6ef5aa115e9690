/* What the program and the module libtessera_imageio agree on: C, so that neither needs the other to be linked. */
#ifndef TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H
#define TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Takes the bytes of the file; called once. */
typedef void tessera_imageio_take_function(void* user, const unsigned char* bytes, size_t count);

/* Encodes RGBA pixels of 8 bits, rows from the top, as an image without alpha in the format that `ending` (".png") stands for.
   Returns 0, or 1 and a reason in `message` (cut to message_size, always ended). The file is the program's business: some of
   OpenImageIO's writers do not notice a full disk. */
typedef int tessera_imageio_encode_function(const char* ending, const unsigned char* rgba, int width, int height, ptrdiff_t stride_bytes,
                                            tessera_imageio_take_function* take, void* user, char* message, size_t message_size);

#define TESSERA_IMAGEIO_ENCODE_NAME "tessera_imageio_encode_1" /* the number changes with the signature */
#define TESSERA_IMAGEIO_FILE_NAME "libtessera_imageio.so.0"

#ifdef __cplusplus
}
#endif

#endif
