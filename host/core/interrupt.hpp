// Ctrl-C as a flag that long work looks at between pieces.
#pragma once

namespace eyeray {

// Makes SIGINT and SIGTERM set the flag; a second signal ends the process at once with exit code 130. Signals
// within a tenth of a second are one: timeout(1) sends its signal to the process and then to the group.
void catch_interrupts();

// Whether the user asked to stop. Safe from any thread.
bool interrupted();

}  // namespace eyeray
