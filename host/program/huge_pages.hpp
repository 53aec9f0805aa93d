#pragma once

namespace eyeray::engine::program {

// To be called first. Where Linux gives huge pages to who asks for them ("madvise"), starts the program anew,
// under the same process id, with a glibc that asks: it reads whether to only as a program starts. Most of
// what eyeray does is on memory that is new to it, and a fault for each 4 KiB of it takes longer than the
// work. Returns where that is done, would change nothing, or is not wanted: where GLIBC_TUNABLES is set, and
// under a debugger or whatever else is preloaded. Programs that eyeray starts are not told.
void use_huge_pages(char** argv);

}  // namespace eyeray::engine::program
