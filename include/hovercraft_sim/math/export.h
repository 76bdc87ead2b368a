#pragma once

/// Marks what the shared libraries hand out: a function or a class that is defined in a source file
/// and that a program may use. Everything else is hidden (-fvisibility=hidden), inline functions
/// and instances of templates always: a program compiled with other options has symbols of the same
/// names, and the loader would put them in the place of the library's (ARCHITECTURE.md,
/// Determinism).
#define HOVERCRAFT_PUBLIC __attribute__((visibility("default")))

/// On a template in a public class, whose instances are for the library alone.
#define HOVERCRAFT_HIDDEN __attribute__((visibility("hidden")))
