# SPDX-License-Identifier: Apache-2.0
# The exports of geometry: our own loader reads them back, then VTK, trimesh and PROJ do what ParaView, Blender and
# Google Earth would. To be included by CMakeLists.txt.
set(here ${CMAKE_CURRENT_LIST_DIR})
wavetracer_test(convert_geometry
  SOURCES ${here}/vtk_glb_kml_run.cpp ${here}/vtk_glb_kml_test.cpp
  LINKS wavetracer_jobs wavetracer_convert wavetracer_results wavetracer_simulation wavetracer_config LABELS host)
set_tests_properties(convert_geometry PROPERTIES FIXTURES_SETUP convert_geometry_files)

function(geometry_script name python script)
  wavetracer_script_test(${name} ${python} ${here}/${script}.py ${CMAKE_BINARY_DIR}/tests/convert_geometry)
  set_tests_properties(${name} PROPERTIES LABELS host FIXTURES_REQUIRED convert_geometry_files)
endfunction()
geometry_script(convert_vtk ${WAVETRACER_PYTHON} vtk_check)
geometry_script(convert_glb ${WAVETRACER_PYTHON} glb_check)
geometry_script(convert_glb_trimesh ${WAVETRACER_PYPI_PYTHON} glb_trimesh)
geometry_script(convert_kml_check ${WAVETRACER_PYPI_PYTHON} kml_check)

# The examples of docs/formats.md, on the runs that the other exports are tested with.
add_test(NAME convert_documentation COMMAND sh -c
  "python='${WAVETRACER_PYPI_PYTHON}'; test -x \"$python\" || python='${WAVETRACER_PYTHON}'; \
   exec \"$python\" '${here}/vtk_glb_kml_docs.py' '$<TARGET_FILE:wavetracer>' '${CMAKE_BINARY_DIR}/tests/convert/drive' \
   '${CMAKE_BINARY_DIR}/tests/convert/arrays' '${CMAKE_BINARY_DIR}/tests/convert/documentation'")
set_tests_properties(convert_documentation PROPERTIES LABELS device FIXTURES_REQUIRED "convert_drive;convert_arrays"
                     TIMEOUT 300)
