# Never fails: makes ctest name, among what did not run, the cases that real bodies are missing for.
if(EXISTS "${DATA}/bodies")
  message(STATUS "real bodies are read from ${DATA}")
else()
  message("skipped: the cases of anatomy, geometry, io and synth that read real bodies checked nothing, for there is "
          "no ${DATA}/bodies; BODICE_TEST_DATA names another folder")
endif()
