# SPDX-License-Identifier: Apache-2.0
# Fails if a source includes a header of a folder of host/ that it must not use.
# cmake -DROOT=the project -DSOURCES="files" -DALLOWED="folders" -DADVICE=what to do -DSTAMP=file -P
# check_includes.cmake
cmake_minimum_required(VERSION 3.25)
separate_arguments(ALLOWED)
separate_arguments(SOURCES)
set(faults "")
foreach(source ${SOURCES})
  file(STRINGS ${source} includes REGEX "^#include \"[a-z_0-9]+/")
  foreach(include ${includes})
    string(REGEX REPLACE "^#include \"([a-z_0-9]+)/.*" "\\1" folder "${include}")
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" header "${include}")
    if(EXISTS ${ROOT}/host/${header} AND NOT folder IN_LIST ALLOWED)
      file(RELATIVE_PATH name ${ROOT} ${source})
      string(APPEND faults "\n  ${name}: ${include}")
    endif()
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "Sources may include headers of these folders here: ${ALLOWED}. These includes are of others:"
                      "${faults}\n${ADVICE}")
endif()
file(TOUCH ${STAMP})
