# In: FROND, the command; CORN, a plant; OUT, a folder. What is exported is read again: surfaces in every format, the plant as
# URDF; vertex cache and table have a sample for each step and the start.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})

include(${CMAKE_CURRENT_LIST_DIR}/run_command.cmake)

foreach(ending glb gltf obj ply)
    run(said export ${CORN} --out ${OUT}/corn.${ending} --at 0.1)
    expect("${status}" "^0$")
    run(said inspect ${OUT}/corn.${ending})
    expect("${said}" "1184 triangles")
endforeach()
# Names of organs survive.
run(said inspect ${OUT}/corn.glb --json)
expect("${said}" "\"organs\"")
expect("${said}" "stalk|stem")

run(said export ${CORN} --at 0.1 --cache ${OUT}/corn.pc2 --csv ${OUT}/corn.csv --urdf ${OUT}/corn.urdf --set mechanics=rod)
expect("${status}" "^0$")
# 32 bytes, then 925 vertices of 12 bytes at the start and after each of six steps.
file(SIZE ${OUT}/corn.pc2 size)
expect("${size}" "^77732$")
file(STRINGS ${OUT}/corn.csv lines)
list(LENGTH lines count)
expect("${count}" "^8$")
list(GET lines 7 last)
string(REPLACE "," ";" fields "${last}")
list(LENGTH fields count)
expect("${count}" "^15$")
list(GET fields 6 held)
expect("${held}" "^[1-9]")
run(said run ${OUT}/corn.urdf --steps 3 --set mechanics=rod)
expect("${said}" "trouble: none")

run(said export ${CORN} --out ${OUT}/corn.xyz)
expect("${said}" "surfaces are written as .gltf .glb .obj .ply")
run(said export ${CORN})
expect("${said}" "nothing to write")
run(said export ${CORN} --csv /dev/null/x.csv)
expect("${said}" "cannot be written")
