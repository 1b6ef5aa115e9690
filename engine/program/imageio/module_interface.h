/* What the program and the module libtessera_imageio agree on: C, so that neither needs the other to be
 * linked. */
#ifndef TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H
#define TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Takes the bytes of the file; called once. */
typedef void tessera_imageio_take_function(void* user, const unsigned char* bytes, size_t count);

/* Each function returns 0, or 1 and a reason in `message` (cut to message_size, always ended). Files are the
   program's business: some of OpenImageIO's writers do not notice a full disk. */

/* Encodes RGBA pixels of 8 bits, rows from the top, as an image without alpha in the format that `ending`
   (".png") stands for. compression: of PNG, 0 .. 9; -1: a quick one. */
typedef int tessera_imageio_encode_function(const char* ending, const unsigned char* rgba, int width,
                                            int height, ptrdiff_t stride_bytes, int compression,
                                            tessera_imageio_take_function* take, void* user, char* message,
                                            size_t message_size);

/* Encodes a PNG of 1, 2, 4 or 8 bits a pixel: indices into palette_entries colours of 3 bytes, or greys where
 * there are none. */
typedef int tessera_imageio_encode_indexed_function(const unsigned char* indices, int width, int height,
                                                    int bits, const unsigned char* palette,
                                                    int palette_entries, int compression,
                                                    tessera_imageio_take_function* take, void* user,
                                                    char* message, size_t message_size);

/* Decodes the bytes of an image file; `take` receives width, height and the file's number of channels, 1 to 4
   (of more the first), as three ints, then RGBA pixels, rows from the top: of one and two channels red =
   green = blue, alpha 255 where there is none. */
typedef int tessera_imageio_decode_function(const char* ending, const unsigned char* bytes, size_t count,
                                            int max_side_px, tessera_imageio_take_function* take, void* user,
                                            char* message, size_t message_size);

/* The endings of the formats that can be written, with commas between. */
typedef int tessera_imageio_formats_function(tessera_imageio_take_function* take, void* user, char* message,
                                             size_t message_size);

/* Every PNG that is encoded says that this is its "Software", before its pixels. */
#define TESSERA_IMAGEIO_SOFTWARE "Tessera"

/* The numbers change with the signatures. */
#define TESSERA_IMAGEIO_ENCODE_NAME "tessera_imageio_encode_2"
#define TESSERA_IMAGEIO_ENCODE_INDEXED_NAME "tessera_imageio_encode_indexed_1"
#define TESSERA_IMAGEIO_DECODE_NAME "tessera_imageio_decode_2"
#define TESSERA_IMAGEIO_FORMATS_NAME "tessera_imageio_formats_1"
#define TESSERA_IMAGEIO_FILE_NAME "libtessera_imageio.so." TESSERA_SOVERSION

#ifdef __cplusplus
}
#endif

#endif
