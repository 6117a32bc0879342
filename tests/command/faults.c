/* Loaded before the C library by commit_test.py: the process is killed at its Nth rename
   (KILL_AT_RENAME=N), or the disk is full from its Nth write to a regular file on
   (FULL_AT_WRITE=N). With COUNT_FILE=PATH it says at its end how many of both there were. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static int renames;
static int writes;

static int limit(const char* name) {
  const char* value = getenv(name);
  return value == NULL ? 0 : atoi(value);
}

int rename(const char* from, const char* to) {
  static int (*real)(const char*, const char*);
  if (real == NULL) real = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  if (++renames == limit("KILL_AT_RENAME")) raise(SIGKILL);
  return real(from, to);
}

static int is_full(int file) {
  struct stat status;
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const int first = limit("FULL_AT_WRITE");
  return ++writes >= first && first > 0;
}

ssize_t write(int file, const void* bytes, size_t count) {
  static ssize_t (*real)(int, const void*, size_t);
  if (real == NULL) real = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  if (is_full(file)) {
    errno = ENOSPC;
    return -1;
  }
  return real(file, bytes, count);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  static ssize_t (*real)(int, const struct iovec*, int);
  if (real == NULL) real = (ssize_t(*)(int, const struct iovec*, int))dlsym(RTLD_NEXT, "writev");
  if (is_full(file)) {
    errno = ENOSPC;
    return -1;
  }
  return real(file, parts, count);
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("COUNT_FILE");
  FILE* file = path == NULL ? NULL : fopen(path, "w");
  if (file == NULL) return;
  fprintf(file, "%d %d\n", renames, writes);
  fclose(file);
}
