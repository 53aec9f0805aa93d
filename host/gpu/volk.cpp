// The only translation unit with volk's code, which Debian ships as source.
#include <volk.c>
