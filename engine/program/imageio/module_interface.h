/* Interface between the program and the module libtessera_imageio. It is plain C and loaded at run time, so
 * that the program does not link OpenImageIO. */
#ifndef TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H
#define TESSERA_ENGINE_IMAGEIO_MODULE_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives the bytes of the file; called once. */
typedef void tessera_imageio_take_function(void* user, const unsigned char* bytes, size_t count);

/* Each function returns 0, or 1 with a reason in `message` (truncated to message_size, always terminated).
   The program reads and writes the files: some of OpenImageIO's writers do not notice a full disk. */

/* Encodes RGBA pixels of 8 bits per component, rows from the top.
   extension  selects the format: ".tif"
   channels   of the image: 3, without alpha, or 4 */
typedef int tessera_imageio_encode_function(const char* extension, const unsigned char* rgba, int width,
                                            int height, ptrdiff_t stride_bytes, int channels,
                                            tessera_imageio_take_function* take, void* user, char* message,
                                            size_t message_size);

/* Decodes an image file. `take` receives three ints, width, height and number of channels (1 to 4; further
   ones are ignored), then RGBA pixels, rows from the top. With one or two channels red = green = blue;
   without alpha it is 255. */
typedef int tessera_imageio_decode_function(const char* extension, const unsigned char* bytes, size_t count,
                                            int max_side_px, tessera_imageio_take_function* take, void* user,
                                            char* message, size_t message_size);

/* Delivers the file name extensions of the writable formats, separated by commas. */
typedef int tessera_imageio_formats_function(tessera_imageio_take_function* take, void* user, char* message,
                                             size_t message_size);

/* The numbers change with the signatures. */
#define TESSERA_IMAGEIO_ENCODE_NAME "tessera_imageio_encode_4"
#define TESSERA_IMAGEIO_DECODE_NAME "tessera_imageio_decode_2"
#define TESSERA_IMAGEIO_FORMATS_NAME "tessera_imageio_formats_1"
#define TESSERA_IMAGEIO_FILE_NAME "libtessera_imageio.so." TESSERA_SOVERSION

#ifdef __cplusplus
}
#endif

#endif
