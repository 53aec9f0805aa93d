#pragma once

namespace eyeray::engine::program {

// To be called first. If Linux gives huge pages on request ("madvise"), restarts the program, under the same
// process id, with a glibc that requests them. A program's glibc reads the setting only at its start. This
// pays because eyeray mostly works on new memory, where a fault for each 4 KiB takes longer than the work.
// Returns if that is done, would change nothing, or is not wanted: if GLIBC_TUNABLES is set, under a
// debugger, or if any library is preloaded. Programs that eyeray starts do not inherit the setting.
void use_huge_pages(char** argv);

}  // namespace eyeray::engine::program
