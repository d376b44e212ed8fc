# Installs a build for another system, then builds programs against it by its toolchain, in C and C++, and runs them by its
# emulator.
include(${CMAKE_CURRENT_LIST_DIR}/run_or_fail.cmake)

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${WORK}/build -DCMAKE_TOOLCHAIN_FILE=${TOOLCHAIN}
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix\;${PREFIX}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
file(GLOB libraries ${WORK}/prefix/bin/*.dll)
file(COPY ${libraries} DESTINATION ${WORK}/build)
file(GLOB programs ${WORK}/build/main_*.exe ${WORK}/build/attach_*.exe)
list(LENGTH programs count)
if(count LESS 4)
    message(FATAL_ERROR "only ${count} programs were built: ${programs}")
endif()
foreach(program IN LISTS programs)
    run(${EMULATOR} ${program})
endforeach()
