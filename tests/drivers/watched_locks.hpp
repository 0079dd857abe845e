// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>

#include <ctime>

#include "tests/drivers/watched_calls.hpp"

/// Every function of the C library that takes, waits for or gives a lock, in a program in which a
/// thread is watched; contended or not. std::mutex and the like stand on them. In one source file a
/// program only.
namespace plumb::tests {

/// Counts, and calls the function of that name behind ours.
template <class... Arguments>
int counted_lock(const char* name, Arguments... arguments) noexcept {
  note_lock();
  return reinterpret_cast<int (*)(Arguments...)>(::dlsym(RTLD_NEXT, name))(arguments...);
}

}  // namespace plumb::tests

extern "C" {
using plumb::tests::counted_lock;

int pthread_mutex_lock(pthread_mutex_t* m) noexcept { return counted_lock(__func__, m); }
int pthread_mutex_trylock(pthread_mutex_t* m) noexcept { return counted_lock(__func__, m); }
int pthread_mutex_unlock(pthread_mutex_t* m) noexcept { return counted_lock(__func__, m); }
int pthread_mutex_timedlock(pthread_mutex_t* m, const timespec* t) noexcept {
  return counted_lock(__func__, m, t);
}
int pthread_mutex_clocklock(pthread_mutex_t* m, clockid_t clock, const timespec* t) noexcept {
  return counted_lock(__func__, m, clock, t);
}

int pthread_rwlock_rdlock(pthread_rwlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_rwlock_wrlock(pthread_rwlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_rwlock_tryrdlock(pthread_rwlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_rwlock_trywrlock(pthread_rwlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_rwlock_unlock(pthread_rwlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_rwlock_timedrdlock(pthread_rwlock_t* l, const timespec* t) noexcept {
  return counted_lock(__func__, l, t);
}
int pthread_rwlock_timedwrlock(pthread_rwlock_t* l, const timespec* t) noexcept {
  return counted_lock(__func__, l, t);
}

int pthread_spin_lock(pthread_spinlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_spin_trylock(pthread_spinlock_t* l) noexcept { return counted_lock(__func__, l); }
int pthread_spin_unlock(pthread_spinlock_t* l) noexcept { return counted_lock(__func__, l); }

int pthread_cond_wait(pthread_cond_t* c, pthread_mutex_t* m) {
  return counted_lock(__func__, c, m);
}
int pthread_cond_timedwait(pthread_cond_t* c, pthread_mutex_t* m, const timespec* t) {
  return counted_lock(__func__, c, m, t);
}
int pthread_cond_clockwait(pthread_cond_t* c, pthread_mutex_t* m, clockid_t clock,
                           const timespec* t) {
  return counted_lock(__func__, c, m, clock, t);
}
int pthread_cond_signal(pthread_cond_t* c) noexcept { return counted_lock(__func__, c); }
int pthread_cond_broadcast(pthread_cond_t* c) noexcept { return counted_lock(__func__, c); }

int sem_wait(sem_t* s) { return counted_lock(__func__, s); }
int sem_trywait(sem_t* s) noexcept { return counted_lock(__func__, s); }
int sem_timedwait(sem_t* s, const timespec* t) { return counted_lock(__func__, s, t); }
int sem_clockwait(sem_t* s, clockid_t clock, const timespec* t) {
  return counted_lock(__func__, s, clock, t);
}
int sem_post(sem_t* s) noexcept { return counted_lock(__func__, s); }
}
