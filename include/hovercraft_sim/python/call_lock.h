#pragma once

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace hovercraft_python {

/// What calls of several threads wait at.
struct CallMutex {
  std::mutex mutex;
  std::atomic<std::thread::id> owner{std::thread::id()};
};

/// A call has what it is made of for itself. A handler of a signal that a long call let in must not
/// wait for that call.
class CallLock {
 public:
  /// @param busy what is said to such a handler. @throws std::runtime_error with it.
  CallLock(CallMutex& of, const char* busy) : of_(of) {
    if (of.owner == std::this_thread::get_id()) throw std::runtime_error(busy);
    of.mutex.lock();
    of.owner = std::this_thread::get_id();
  }
  CallLock(const CallLock&) = delete;
  CallLock& operator=(const CallLock&) = delete;
  ~CallLock() {
    of_.owner = std::thread::id();
    of_.mutex.unlock();
  }

 private:
  CallMutex& of_;
};

}  // namespace hovercraft_python
