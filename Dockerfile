# docker build -t hydroelastic . && docker run --rm -it -v "$PWD":/home/user/work hydroelastic
# The same packages as the private root of ./hydro (dolfinx, PETSc, gmsh, EGL to draw without a screen), so ./hydro
# finds an active Python with dolfinx and adds only what comes from PyPI.
FROM debian:trixie-slim

COPY requirements /tmp/requirements
RUN apt-get update \
    && sed -e 's/#.*//' -e '/^[[:space:]]*$/d' /tmp/requirements/debian.txt \
        | xargs apt-get install --yes --no-install-recommends \
    && rm -rf /var/lib/apt/lists/*

# Containers have no second user to protect; the ordinary user keeps Open MPI and file owners simple.
RUN useradd --create-home user && install --directory --owner=user /home/user/work
USER user
WORKDIR /home/user/hydroelastic
COPY --chown=user . .

# Fills the cache of ./hydro: the virtual environment with the PyPI packages.
RUN ./hydro env

ENV PATH=/home/user/hydroelastic:$PATH
WORKDIR /home/user/work
CMD ["hydro", "shell"]
