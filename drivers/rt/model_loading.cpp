// SPDX-License-Identifier: Apache-2.0
#include "rt/model_loading.hpp"

#include <pthread.h>
#include <signal.h>

#include <atomic>
#include <exception>
#include <thread>

namespace plumb::drivers::rt {

struct ModelLoading::Shared {
  RunningModel model;
  std::exception_ptr error;
  std::atomic<bool> done{false};
};

/// The thread starts with all signals blocked, so that they reach the thread that ends the program.
ModelLoading::ModelLoading(NextModel next) : shared_(std::make_shared<Shared>()) {
  const auto load = [shared = shared_, next = std::move(next)] {
    try {
      shared->model = load_next_model(next);
    } catch (...) {
      shared->error = std::current_exception();
    }
    shared->done.store(true, std::memory_order_release);
  };
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  try {
    std::thread(load).detach();
  } catch (...) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    throw;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

bool ModelLoading::done() const noexcept { return shared_->done.load(std::memory_order_acquire); }

RunningModel ModelLoading::result() {
  if (shared_->error) std::rethrow_exception(shared_->error);
  return std::move(shared_->model);
}

}  // namespace plumb::drivers::rt
