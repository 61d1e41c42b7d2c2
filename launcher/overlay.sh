# shellcheck shell=bash
# This checkout as an import package. Several checkouts share one virtual environment, so none is installed into it:
# a folder of links on PYTHONPATH gives `hydroelastic`, `hydroelastic.fem` and so on, and metadata beside it the version and the
# command line.

make_overlay() {
    new_building
    local folder version metadata requirement
    version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$checkout/pyproject.toml" | head -n 1)
    mkdir -- "$building/hydroelastic" "$building/bin" "$building/hydroelastic-$version.dist-info"
    for folder in physics meshes fem modal output scenes benchmarks; do
        ln -s -- "$checkout/$folder" "$building/hydroelastic/$folder"
    done
    ln -s -- "$checkout"/api/{__init__.py,py.typed} "$building/hydroelastic"
    metadata=$building/hydroelastic-$version.dist-info
    {
        printf 'Metadata-Version: 2.1\nName: hydroelastic\nVersion: %s\n' "$version"
        read_list "$checkout/requirements/run.txt" | while read -r requirement; do
            printf 'Requires-Dist: %s\n' "$requirement"
        done
        printf 'Provides-Extra: bench\n'
        read_list "$checkout/requirements/bench.txt" | while read -r requirement; do
            printf 'Requires-Dist: %s; extra == "bench"\n' "$requirement"
        done
    } >"$metadata/METADATA"
    printf 'hydro\n' >"$metadata/INSTALLER"
    printf '[console_scripts]\nhydroelastic = hydroelastic.scenes.__main__:start\n' >"$metadata/entry_points.txt"
    # shellcheck disable=SC2016
    printf '#!/bin/sh\nexec python -m hydroelastic.scenes "$@"\n' >"$building/bin/hydroelastic"
    chmod +x -- "$building/bin/hydroelastic"
    list_contents
    publish "$overlay"
}
