/// Version of the interface, and of the library that is loaded.
#ifndef BOLTER_VERSION_H
#define BOLTER_VERSION_H

#define BT_VERSION_MAJOR 0
#define BT_VERSION_MINOR 2
#define BT_VERSION_PATCH 0

/// What is documented in include/bolter and may be called from outside.
#if defined(__GNUC__)
#define BT_PUBLIC __attribute__((visibility("default")))
#else
#define BT_PUBLIC
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// The version of the library that is running, "0.2.0". Compare it with the macros, which are the
/// version that the caller was compiled against. Never NULL; static.
BT_PUBLIC const char* bt_version(void);

#ifdef __cplusplus
}
#endif

#endif
