# Limpet from its download, which packaging/portable makes: the distribution, what the program can use, no compiler.
#
#   packaging/portable
#   docker build -t limpet -f Dockerfile build/portable
#   docker run --rm -v "$PWD/out:/work/out" limpet fly perch_concrete
FROM debian:trixie-slim
RUN apt-get update \
    && apt-get install -y --no-install-recommends \
        gnuplot-nox fonts-dejavu-core libmujoco2.2.2 libegl-dev libgl-dev libgl1-mesa-dri openmpi-bin ffmpeg \
    && rm -rf /var/lib/apt/lists/*
ADD limpet-*-linux-x86_64.tar.xz /opt/
RUN ln -s /opt/limpet-*/bin/limpet /usr/local/bin/limpet
WORKDIR /work
ENTRYPOINT ["limpet"]
CMD ["--help"]
