// The one translation unit that holds volk's code; Debian ships it as source.
#include <volk.c>
