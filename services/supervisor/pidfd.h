#pragma once

// Debian 12's header does not say that these are C.
extern "C" {
#include <sys/pidfd.h>
}
