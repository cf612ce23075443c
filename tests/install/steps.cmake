# SPDX-License-Identifier: Apache-2.0
# Steps of tests that install and look at what they get.

# step(COMMAND...): runs a command and leaves its output in `said`.
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}\n${output}")
  endif()
  set(said "${output}" PARENT_SCOPE)
endfunction()

function(expect pattern)
  if(NOT said MATCHES "${pattern}")
    message(FATAL_ERROR "expected ${pattern} in:\n${said}")
  endif()
endfunction()
