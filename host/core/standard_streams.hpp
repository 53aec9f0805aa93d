#pragma once

namespace eyeray {

// Makes the standard streams what a program can rely on, whatever it was started with; to be called first.
//
// What cannot be written to standard error is lost, and never a fault: it may be closed, a full disk, or a
// pipe whose reader has gone. A pipe on standard output may lose its reader as well, who wanted no more; any
// other failure there is one, to be seen by ferror(stdout). No write raises SIGPIPE or SIGXFSZ. Where 0, 1 or
// 2 is closed something stands in for it, so that no file gets its number.
void make_standard_streams_safe();

}  // namespace eyeray
