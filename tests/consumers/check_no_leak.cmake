# Configures a project that adds bodice as a subfolder: no warning flag may reach any file of that build, no test
# or bench of ours may be part of it.
execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}/tests/consumers/add_subdirectory" -B "${SCRATCH}"
                -G "${GENERATOR}" -DBODICE_SOURCE=${SOURCE} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
if(failed)
  message(FATAL_ERROR "a project that embeds bodice does not configure:\n${why}")
endif()
file(READ "${SCRATCH}/compile_commands.json" commands)
if(NOT commands MATCHES "consumers/main.cpp" OR NOT commands MATCHES "collider.cpp")
  message(FATAL_ERROR "the consumer's compile commands hold neither its own file nor ours")
endif()
foreach(leak IN ITEMS "-Werror" "-Wall" "-fsanitize" "/tests/engine/" "/bench/")
  string(FIND "${commands}" "${leak}" at)
  if(NOT at EQUAL -1)
    message(SEND_ERROR "${leak} reaches a project that embeds bodice")
  endif()
endforeach()
