// What the shared library shows of itself.
#pragma once

#define DIPTYCH_EXPORT [[gnu::visibility("default")]]

// The namespace of one binary interface. Names of another interface link as other symbols.
#define DIPTYCH_BEGIN namespace diptych { inline namespace v0 {
#define DIPTYCH_END } }
