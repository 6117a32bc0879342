# SPDX-License-Identifier: Apache-2.0
# Writes OUT, a header with the commit of SOURCE, for `tagfield --version`. Run at each build, but OUT is
# written only if it changes, so that a new commit recompiles only one small source and relinks.
#
#   cmake -DSOURCE=DIR -DTEMPLATE=build_commit.h.in -DOUT=build_commit.h -P TagfieldCommit.cmake
set(COMMIT "")
set(DATE "")
set(CHANGED false)
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)  # Otherwise a tarball, possibly unpacked inside another repository.
  execute_process(COMMAND ${git} -C ${SOURCE} rev-parse --verify --short=12 HEAD
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${git} -C ${SOURCE} log -1 --format=%cs
    OUTPUT_VARIABLE DATE OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${git} -C ${SOURCE} status --porcelain --untracked-files=no
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(COMMIT AND changes)
    set(CHANGED true)
  endif()
endif()
configure_file(${TEMPLATE} ${OUT} @ONLY)
