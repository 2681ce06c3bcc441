#pragma once

namespace mms {

/// Makes OpenMP's threads sleep while they wait; to be called first in main. By default they spin,
/// which next to another busy program makes inference fifty times slower on two threads. OpenMP
/// reads the setting when it is loaded, so the program restarts itself, unless the environment has
/// `OMP_WAIT_POLICY`.
void let_waiting_threads_sleep(char** argv);

}  // namespace mms
