<?xml version="1.0" encoding="utf-8" ?>
<ogr:FeatureCollection
     gml:id="aFeatureCollection"
     xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:schemaLocation="http://ogr.maptools.org/ s.xsd"
     xmlns:ogr="http://ogr.maptools.org/"
     xmlns:gml="http://www.opengis.net/gml/3.2">
  <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::4326"><gml:lowerCorner>48.137 11.575</gml:lowerCorner><gml:upperCorner>48.1372 11.5762</gml:upperCorner></gml:Envelope></gml:boundedBy>
                                                                                                                                                        
  <ogr:featureMember>
    <ogr:s gml:id="s.0">
      <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::4326"><gml:lowerCorner>48.137 11.575</gml:lowerCorner><gml:upperCorner>48.1371 11.5752</gml:upperCorner></gml:Envelope></gml:boundedBy>
      <ogr:geometryProperty><gml:Polygon srsName="urn:ogc:def:crs:EPSG::4326" gml:id="s.geom.0"><gml:exterior><gml:LinearRing><gml:posList>48.137 11.575 48.137 11.5752 48.1371 11.5752 48.1371 11.575 48.137 11.575</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></ogr:geometryProperty>
      <ogr:height>8.5</ogr:height>
      <ogr:floors xsi:nil="true"/>
      <ogr:name>a</ogr:name>
    </ogr:s>
  </ogr:featureMember>
  <ogr:featureMember>
    <ogr:s gml:id="s.1">
      <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::4326"><gml:lowerCorner>48.137 11.576</gml:lowerCorner><gml:upperCorner>48.1372 11.5762</gml:upperCorner></gml:Envelope></gml:boundedBy>
      <ogr:geometryProperty><gml:MultiSurface srsName="urn:ogc:def:crs:EPSG::4326" gml:id="s.geom.1"><gml:surfaceMember><gml:Polygon gml:id="s.geom.1.0"><gml:exterior><gml:LinearRing><gml:posList>48.137 11.576 48.137 11.5762 48.1372 11.5762 48.1372 11.576 48.137 11.576</gml:posList></gml:LinearRing></gml:exterior><gml:interior><gml:LinearRing><gml:posList>48.13705 11.57605 48.1371 11.57605 48.1371 11.5761 48.13705 11.57605</gml:posList></gml:LinearRing></gml:interior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></ogr:geometryProperty>
      <ogr:floors>3</ogr:floors>
    </ogr:s>
  </ogr:featureMember>
</ogr:FeatureCollection>
