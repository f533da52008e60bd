/* carom.h with its functions marked as those that the library gives to others. */

#if defined(_WIN32)
#define CAROM_API __declspec(dllexport)
#else
#define CAROM_API __attribute__((visibility("default")))
#endif

#include "carom.h"
