// SPDX-License-Identifier: Apache-2.0
/* Fault injection, loaded before the C library (LD_PRELOAD): makes system and library calls of a program fail.

   FAULT=CALL:N:WHAT     fails the Nth call, FAULT=CALL:N+:WHAT all calls from the Nth on.
   CALL  rename  rename and renameat2
         write   write and writev to regular files
         read    read, pread and fread's reads of regular files
         sync    fsync and fdatasync
         open    open, openat and fopen, except of system files (/proc, /sys, /dev, /usr, /etc, /lib)
         mkdir   mkdir
         alloc   malloc, calloc and realloc of over 100 bytes
         thread  pthread_create
         clock   clock_gettime of CLOCK_REALTIME
   WHAT  an error: ENOSPC, EIO, EMFILE, ENOMEM, EACCES, EAGAIN; KILL or TERM, a signal before
         the call; or, for clock, an offset in seconds
   COUNT_FILE=PATH       when the program exits, the file gets a line "CALL COUNT" for each kind of call; if it
                         forks, from the last process that exits. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

enum { RENAME, WRITE, READ, SYNC, OPEN, MKDIR, ALLOC, THREAD, CLOCK, CALLS };
static const char* const names[CALLS] = {"rename", "write", "read",   "sync", "open",
                                         "mkdir",  "alloc", "thread", "clock"};
static const struct {
  const char* name;
  int number;
} errors[] = {{"ENOSPC", ENOSPC}, {"EIO", EIO},       {"EMFILE", EMFILE},
              {"ENOMEM", ENOMEM}, {"EACCES", EACCES}, {"EAGAIN", EAGAIN}};

static atomic_long counts[CALLS];
static int faulty = -1; /* the kind of call that fails */
static long first;
static int goes_on;
static int error_number;
static int signal_number;
static long jump_s;

__attribute__((constructor)) static void begin(void) {
  const char* fault = getenv("FAULT");
  if (fault == NULL) return;
  char call[16];
  char what[16];
  char plus[2];
  if (sscanf(fault, "%15[a-z]:%ld+:%15s", call, &first, what) == 3) {
    goes_on = 1;
  } else if (sscanf(fault, "%15[a-z]:%ld%1[:]%15s", call, &first, plus, what) != 4) {
    fprintf(stderr, "faults.c: FAULT=%s is not CALL:N:WHAT\n", fault);
    _exit(99);
  }
  if (strcmp(what, "KILL") == 0) signal_number = SIGKILL;
  if (strcmp(what, "TERM") == 0) signal_number = SIGTERM;
  jump_s = atol(what);
  for (size_t i = 0; i < sizeof errors / sizeof *errors; ++i) {
    if (strcmp(what, errors[i].name) == 0) error_number = errors[i].number;
  }
  for (int i = 0; i < CALLS; ++i) {
    if (strcmp(call, names[i]) == 0) faulty = i;
  }
  if (faulty < 0 || (signal_number == 0 && error_number == 0 && jump_s == 0)) _exit(99);
}

/* Whether this call fails; may terminate the program by a signal instead. */
static int goes_wrong(int call) {
  const long now = atomic_fetch_add(&counts[call], 1) + 1;
  if (call != faulty || (goes_on ? now < first : now != first)) return 0;
  if (signal_number != 0) return raise(signal_number);
  errno = error_number;
  return 1;
}

static void* real(const char* name) { return dlsym(RTLD_NEXT, name); }

static int is_regular(int file) {
  struct stat status;
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

static int is_of_system(const char* path) {
  static const char* const places[] = {"/proc", "/sys", "/dev", "/usr", "/etc", "/lib"};
  for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
    if (strncmp(path, places[i], strlen(places[i])) == 0) return 1;
  }
  return 0;
}

int rename(const char* from, const char* to) {
  static int (*next)(const char*, const char*);
  if (next == NULL) next = (int (*)(const char*, const char*))real("rename");
  return goes_wrong(RENAME) ? -1 : next(from, to);
}

int renameat2(int from_at, const char* from, int to_at, const char* to, unsigned flags) {
  static int (*next)(int, const char*, int, const char*, unsigned);
  if (next == NULL) next = (int (*)(int, const char*, int, const char*, unsigned))real("renameat2");
  return goes_wrong(RENAME) ? -1 : next(from_at, from, to_at, to, flags);
}

ssize_t write(int file, const void* bytes, size_t count) {
  static ssize_t (*next)(int, const void*, size_t);
  if (next == NULL) next = (ssize_t(*)(int, const void*, size_t))real("write");
  return is_regular(file) && goes_wrong(WRITE) ? -1 : next(file, bytes, count);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  static ssize_t (*next)(int, const struct iovec*, int);
  if (next == NULL) next = (ssize_t(*)(int, const struct iovec*, int))real("writev");
  return is_regular(file) && goes_wrong(WRITE) ? -1 : next(file, parts, count);
}

ssize_t read(int file, void* bytes, size_t count) {
  static ssize_t (*next)(int, void*, size_t);
  if (next == NULL) next = (ssize_t(*)(int, void*, size_t))real("read");
  return is_regular(file) && goes_wrong(READ) ? -1 : next(file, bytes, count);
}

ssize_t pread(int file, void* bytes, size_t count, off_t at) {
  static ssize_t (*next)(int, void*, size_t, off_t);
  if (next == NULL) next = (ssize_t(*)(int, void*, size_t, off_t))real("pread");
  return goes_wrong(READ) ? -1 : next(file, bytes, count, at);
}

size_t fread(void* bytes, size_t size, size_t count, FILE* file) {
  static size_t (*next)(void*, size_t, size_t, FILE*);
  if (next == NULL) next = (size_t(*)(void*, size_t, size_t, FILE*))real("fread");
  return is_regular(fileno(file)) && goes_wrong(READ) ? 0 : next(bytes, size, count, file);
}

int fsync(int file) {
  static int (*next)(int);
  if (next == NULL) next = (int (*)(int))real("fsync");
  return goes_wrong(SYNC) ? -1 : next(file);
}

int fdatasync(int file) {
  static int (*next)(int);
  if (next == NULL) next = (int (*)(int))real("fdatasync");
  return goes_wrong(SYNC) ? -1 : next(file);
}

static mode_t mode_of(int flags, va_list rest) {
  return (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
}

int open(const char* path, int flags, ...) {
  static int (*next)(const char*, int, ...);
  if (next == NULL) next = (int (*)(const char*, int, ...))real("open");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return !is_of_system(path) && goes_wrong(OPEN) ? -1 : next(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  static int (*next)(int, const char*, int, ...);
  if (next == NULL) next = (int (*)(int, const char*, int, ...))real("openat");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return !is_of_system(path) && goes_wrong(OPEN) ? -1 : next(folder, path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  static FILE* (*next)(const char*, const char*);
  if (next == NULL) next = (FILE * (*)(const char*, const char*)) real("fopen");
  return !is_of_system(path) && goes_wrong(OPEN) ? NULL : next(path, mode);
}

FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

int mkdir(const char* path, mode_t mode) {
  static int (*next)(const char*, mode_t);
  if (next == NULL) next = (int (*)(const char*, mode_t))real("mkdir");
  return goes_wrong(MKDIR) ? -1 : next(path, mode);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*what)(void*), void* with) {
  static int (*next)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  if (next == NULL) {
    next = (int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*))real("pthread_create");
  }
  return goes_wrong(THREAD) ? error_number : next(thread, how, what, with);
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  static int (*next)(clockid_t, struct timespec*);
  if (next == NULL) next = (int (*)(clockid_t, struct timespec*))real("clock_gettime");
  const int result = next(clock, time);
  if (clock == CLOCK_REALTIME && goes_wrong(CLOCK)) time->tv_sec += jump_s;
  return result;
}

/* The C library's internal names of the allocators, as dlsym() itself may allocate. */
extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
enum { SMALL = 100 };

void* malloc(size_t size) { return size > SMALL && goes_wrong(ALLOC) ? NULL : __libc_malloc(size); }

void* calloc(size_t count, size_t size) {
  return size != 0 && count > SMALL / size && goes_wrong(ALLOC) ? NULL : __libc_calloc(count, size);
}

void* realloc(void* old, size_t size) {
  return size > SMALL && goes_wrong(ALLOC) ? NULL : __libc_realloc(old, size);
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("COUNT_FILE");
  faulty = -1;
  FILE* file = path == NULL ? NULL : fopen(path, "w");
  if (file == NULL) return;
  for (int i = 0; i < CALLS; ++i) fprintf(file, "%s %ld\n", names[i], (long)counts[i]);
  fclose(file);
}
