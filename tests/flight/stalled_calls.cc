// Loaded before a program's libraries (LD_PRELOAD): calls of one of its threads hang or throw from
// the moment on at which the file SAKER_STALL says so: "hang THREAD" (its next sleep does not end),
// "sync THREAD" (its next fdatasync does not), "throw THREAD" (it gets no memory).
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>

namespace {

template <class Call>
Call* next(const char* name) {
  return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name));
}

/// Whether "WHAT THREAD" stands in the file, of this thread.
bool told(const char* what) {
  const char* file = std::getenv("SAKER_STALL");
  if (file == nullptr) return false;
  const int descriptor = open(file, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  char said[64] = {}, wanted[64] = {}, name[32] = {};
  const ssize_t size = read(descriptor, said, sizeof said - 1);
  close(descriptor);
  pthread_getname_np(pthread_self(), name, sizeof name);
  std::strcat(std::strcat(std::strcat(wanted, what), " "), name);
  return size > 0 && std::strcmp(said, wanted) == 0;
}

void hang_where(const char* what) {
  while (told(what)) pause();
}

/// Memory is asked for often: the file is looked at twenty times a second.
bool memory_is_gone() {
  thread_local timespec looked{};
  thread_local bool gone = false;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const long since_ms =
      (now.tv_sec - looked.tv_sec) * 1000 + (now.tv_nsec - looked.tv_nsec) / 1000000;
  if (since_ms < 50) return gone;
  looked = now;
  gone = told("throw");
  return gone;
}

}  // namespace

extern "C" int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  static auto* const real =
      next<int(clockid_t, int, const timespec*, timespec*)>("clock_nanosleep");
  hang_where("hang");
  return real(clock, flags, time, left);
}

extern "C" int nanosleep(const timespec* time, timespec* left) {
  static auto* const real = next<int(const timespec*, timespec*)>("nanosleep");
  hang_where("hang");
  return real(time, left);
}

extern "C" int fdatasync(int descriptor) {
  static auto* const real = next<int(int)>("fdatasync");
  hang_where("sync");
  return real(descriptor);
}

void* operator new(std::size_t size) {
  if (memory_is_gone()) throw std::bad_alloc();
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
