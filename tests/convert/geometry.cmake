# The exports of geometry: our own loader reads them back, then VTK, trimesh and PROJ do what ParaView, Blender and
# Google Earth would. To be included by CMakeLists.txt.
set(here ${CMAKE_CURRENT_LIST_DIR})
wavetracer_test(convert_geometry
  SOURCES ${here}/vtk_glb_kml_run.cpp ${here}/vtk_glb_kml_test.cpp
  LINKS wavetracer_jobs wavetracer_convert wavetracer_results wavetracer_simulation wavetracer_config LABELS host)
set_tests_properties(convert_geometry PROPERTIES FIXTURES_SETUP convert_geometry_files)

# The venv has the packages of PyPI.
function(geometry_script name python script)
  if(python)
    add_test(NAME ${name} COMMAND ${python} ${here}/${script} ${CMAKE_BINARY_DIR}/tests/convert_geometry)
    set_tests_properties(${name} PROPERTIES LABELS host FIXTURES_REQUIRED convert_geometry_files SKIP_RETURN_CODE 77
                                            TIMEOUT 300)
  endif()
endfunction()
geometry_script(convert_vtk "${WAVETRACER_PYTHON}" vtk_check.py)
geometry_script(convert_glb "${WAVETRACER_PYTHON}" glb_check.py)
find_program(WAVETRACER_SH sh)
foreach(script glb_trimesh kml_check)  # the venv may come after CMake: sh looks for it when the test runs
  add_test(NAME convert_${script} COMMAND ${WAVETRACER_SH} -c
    "test -x '${CMAKE_BINARY_DIR}/consumers/bin/python3' || exit 77; \
     exec '${CMAKE_BINARY_DIR}/consumers/bin/python3' '${here}/${script}.py' '${CMAKE_BINARY_DIR}/tests/convert_geometry'")
  set_tests_properties(convert_${script} PROPERTIES LABELS host FIXTURES_REQUIRED convert_geometry_files
                                                    SKIP_RETURN_CODE 77 TIMEOUT 300)
endforeach()

# The examples of docs/formats.md, on the runs that the other exports are tested with.
add_test(NAME convert_documentation COMMAND ${WAVETRACER_SH} -c
  "python='${CMAKE_BINARY_DIR}/consumers/bin/python3'; test -x \"$python\" || python='${WAVETRACER_PYTHON}'; \
   exec \"$python\" '${here}/vtk_glb_kml_docs.py' '$<TARGET_FILE:wavetracer>' '${CMAKE_BINARY_DIR}/tests/convert/drive' \
   '${CMAKE_BINARY_DIR}/tests/convert/arrays' '${CMAKE_BINARY_DIR}/tests/convert/documentation'")
set_tests_properties(convert_documentation PROPERTIES LABELS device FIXTURES_REQUIRED "convert_drive;convert_arrays"
                     TIMEOUT 300)
