// How a source is built.
#pragma once

// The machine, a set of instructions, that a source is built for. All that the core defines as a template or inline
// stands in a namespace of that name, so that the linker cannot take an inline function of one build for that of
// another: it would run on a processor that lacks its instructions. Plain data, the same for all of them, stands in
// `pendula` itself.
#ifndef PENDULA_MACHINE
#define PENDULA_MACHINE common
#endif

// Kernels are small and must be inlined into the loop that the compiler vectorises or pipelines; under a sanitizer
// they are not small. Where a program has to be small, as in a browser, the compiler decides for sources that say so.
#if defined(PENDULA_SANITIZED) || defined(PENDULA_SMALL)
#define PENDULA_INLINE inline
#else
#define PENDULA_INLINE [[gnu::always_inline]] inline
#endif
