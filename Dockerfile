# Limpet from its own Debian packages: the first stage makes them as packaging/build does anywhere, the second has
# nothing but the distribution and them.
#
#   docker build -t limpet .
#   docker run --rm -v "$PWD/out:/work/out" limpet fly perch_concrete
FROM debian:bookworm AS build
COPY . /limpet
RUN /limpet/packaging/build

FROM debian:bookworm-slim
COPY --from=build /limpet/build/packages/*.deb /packages/
RUN apt-get update \
    && apt-get install -y --no-install-recommends /packages/*.deb libgl1-mesa-dri python3-matplotlib ffmpeg \
    && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["limpet"]
CMD ["--help"]
