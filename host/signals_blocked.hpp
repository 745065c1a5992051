// SPDX-License-Identifier: Apache-2.0
// Threads that leave signals to the session's.
#pragma once

#include <pthread.h>

#include <csignal>

namespace penduline {

/// While it lives no signal but a fault of its own comes to this thread; nor ever to threads that
/// it starts meanwhile. A signal that ends a wait must come to the thread that waits.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t signals;
    sigfillset(&signals);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
      sigdelset(&signals, fault);
    }
    pthread_sigmask(SIG_SETMASK, &signals, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace penduline
